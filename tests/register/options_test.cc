// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(RegistrationOptions, CheckNamesEachFieldOfTheSearch) {
  [[maybe_unused]] const auto& [reach,
                                width,
                                step,
                                grid,
                                starts,
                                distinct,
                                again,
                                rounds,
                                centres,
                                length,
                                orientations,
                                grid_blur,
                                climb_blur,
                                growth,
                                corner,
                                climb_distinct,
                                climbs,
                                least_step,
                                climb_rounds,
                                climb_reach,
                                shown,
                                weakest,
                                half] = HypothesisOptions();
  ExpectCheckNamesEach<HypothesisOptions>({
      {"reach_sigmas", [](auto& o) { o.reach_sigmas = kNotANumber; }},
      {"width_cells", [](auto& o) { o.width_cells = 0; }},
      {"step_cells", [](auto& o) { o.step_cells = 0; }},
      {"max_grid_points", [](auto& o) { o.max_grid_points = 0; }},
      {"max_starts", [](auto& o) { o.max_starts = -1; }},
      {"distinct_cells", [](auto& o) { o.distinct_cells = kInfinity; }},
      {"again_below_nats_per_observation",
       [](auto& o) { o.again_below_nats_per_observation = -1; }},
      {"max_rounds", [](auto& o) { o.max_rounds = 0; }},
      {"num_centres", [](auto& o) { o.num_centres = 0; }},
      {"observation_length_px", [](auto& o) { o.observation_length_px = 0; }},
      {"num_orientations", [](auto& o) { o.num_orientations = 0; }},
      {"grid_blur_steps", [](auto& o) { o.grid_blur_steps = 0; }},
      {"climb_blur_cells", [](auto& o) { o.climb_blur_cells = kNotANumber; }},
      {"step_growth", [](auto& o) { o.step_growth = 1; }},
      {"corner_reach", [](auto& o) { o.corner_reach = 0.9; }},
      {"climb_distinct_steps", [](auto& o) { o.climb_distinct_steps = -1; }},
      {"climbs_per_start", [](auto& o) { o.climbs_per_start = 0; }},
      {"least_climb_step_cells", [](auto& o) { o.least_climb_step_cells = 0; }},
      {"climb_rounds", [](auto& o) { o.climb_rounds = 0; }},
      {"climb_reach_sigmas", [](auto& o) { o.climb_reach_sigmas = kInfinity; }},
      {"shown_share", [](auto& o) { o.shown_share = 0; }},
      {"min_gradient", [](auto& o) { o.min_gradient = -1; }},
      {"half_weight_gradient", [](auto& o) { o.half_weight_gradient = 0; }},
  });
}

TEST(RegistrationOptions, CheckNamesEachFieldOfMatchingAndScore) {
  [[maybe_unused]] const auto& [range, candidates, gate, outliers, observation] = MatchOptions();
  ExpectCheckNamesEach<MatchOptions>({
      {"final_range_px", [](auto& o) { o.final_range_px = 0; }},
      {"max_candidates", [](auto& o) { o.max_candidates = 0; }},
      {"gate_deg", [](auto& o) { o.gate_deg = 91; }},
      {"outlier_share", [](auto& o) { o.outlier_share = 1; }},
      {"observation_length_px", [](auto& o) { o.observation_length_px = kNotANumber; }},
  });
  [[maybe_unused]] const auto& [noise, clutter, length, angle, shown, most] = ScoreOptions();
  ExpectCheckNamesEach<ScoreOptions>({
      {"noise_px", [](auto& o) { o.noise_px = 0; }},
      {"clutter_range_px", [](auto& o) { o.clutter_range_px = -12; }},
      {"observation_length_px", [](auto& o) { o.observation_length_px = 0; }},
      {"gate_deg", [](auto& o) { o.gate_deg = kNotANumber; }},
      {"shown_share", [](auto& o) { o.shown_share = 1; }},
      {"max_candidates", [](auto& o) { o.max_candidates = 0; }},
  });
  [[maybe_unused]] const auto& [offset, turn, shared] = EdgeBias();
  ExpectCheckNamesEach<EdgeBias>({
      {"edge_offset_sigmas", [](auto& o) { o.edge_offset_sigmas = 0; }},
      {"edge_turn_sigmas", [](auto& o) { o.edge_turn_sigmas = kInfinity; }},
      {"shared_offset_sigmas", [](auto& o) { o.shared_offset_sigmas = -1; }},
  });
}

TEST(RegistrationOptions, CheckNamesEachFieldOfRefinement) {
  [[maybe_unused]] const auto& [start,
                                shrink,
                                spacing,
                                border,
                                matching,
                                bias,
                                noise,
                                matched,
                                final_steps,
                                annealing_iterations,
                                final_iterations,
                                tolerance,
                                settled] = RefineOptions();
  ExpectCheckNamesEach<RefineOptions>({
      {"start_sigmas", [](auto& o) { o.start_sigmas = -1; }},
      {"shrink", [](auto& o) { o.shrink = 1; }},
      {"spacing_px", [](auto& o) { o.spacing_px = 0; }},
      {"border_px", [](auto& o) { o.border_px = -1; }},
      {"min_matched", [](auto& o) { o.min_matched = 0; }},
      {"num_final_steps", [](auto& o) { o.num_final_steps = 0; }},
      {"annealing_iterations", [](auto& o) { o.annealing_iterations = 0; }},
      {"final_iterations", [](auto& o) { o.final_iterations = 0; }},
      {"function_tolerance", [](auto& o) { o.function_tolerance = kNotANumber; }},
      {"settled_sigmas", [](auto& o) { o.settled_sigmas = 0; }},
      {"matching.gate_deg", [](auto& o) { o.matching.gate_deg = 0; }},
      {"bias.edge_turn_sigmas", [](auto& o) { o.bias.edge_turn_sigmas = 0; }},
      {"min_noise_px", [](auto& o) { o.min_noise_px = 1.5; }},  // above half the final range
  });
  [[maybe_unused]] const auto& [common,
                                common_turn,
                                group_offset,
                                usual_quartile,
                                least_groups,
                                least_group_offset,
                                least_edges,
                                most_groups,
                                widest,
                                ground,
                                own,
                                degrees,
                                least_own,
                                most_own,
                                least_shared,
                                most_shared,
                                k1,
                                view_angle,
                                aspect,
                                own_shift,
                                tie_loss,
                                relief,
                                widest_relief,
                                survey_loss,
                                corner,
                                shared_survey,
                                moved_tag,
                                rounds,
                                range,
                                spare,
                                narrowing,
                                least_noise,
                                joint_matching] = JointOptions();
  ExpectCheckNamesEach<JointOptions>({
      {"common_offset_sigmas", [](auto& o) { o.common_offset_sigmas = 0; }},
      {"common_turn_sigmas", [](auto& o) { o.common_turn_sigmas = kNotANumber; }},
      {"group_offset_sigmas", [](auto& o) { o.group_offset_sigmas = kNotANumber; }},
      {"usual_group_quartile_sigmas", [](auto& o) { o.usual_group_quartile_sigmas = 0; }},
      {"least_groups", [](auto& o) { o.least_groups = 0; }},
      {"least_group_offset_sigmas", [](auto& o) { o.least_group_offset_sigmas = 2; }},
      {"least_edges_of_group", [](auto& o) { o.least_edges_of_group = 0; }},
      {"most_groups", [](auto& o) { o.most_groups = -1; }},
      {"widest_offset_sigmas", [](auto& o) { o.widest_offset_sigmas = 0; }},
      {"ground_level_sigmas", [](auto& o) { o.ground_level_sigmas = 0; }},
      {"own.edge_offset_sigmas", [](auto& o) { o.own.edge_offset_sigmas = 0; }},
      {"own_degrees_of_freedom", [](auto& o) { o.own_degrees_of_freedom = 0; }},
      {"least_own_offset_sigmas", [](auto& o) { o.least_own_offset_sigmas = 0; }},
      {"most_own_offset_sigmas", [](auto& o) { o.most_own_offset_sigmas = 0.01; }},
      {"least_shared_offset_sigmas", [](auto& o) { o.least_shared_offset_sigmas = 0; }},
      {"most_shared_offset_sigmas", [](auto& o) { o.most_shared_offset_sigmas = 0.01; }},
      {"own_k1_share", [](auto& o) { o.own_k1_share = 0; }},
      {"own_view_angle_share", [](auto& o) { o.own_view_angle_share = 1.1; }},
      {"own_aspect_share", [](auto& o) { o.own_aspect_share = kNotANumber; }},
      {"own_shift_share", [](auto& o) { o.own_shift_share = 0; }},
      {"tie_loss_sigmas", [](auto& o) { o.tie_loss_sigmas = 0; }},
      {"survey_loss_sigmas", [](auto& o) { o.survey_loss_sigmas = 0; }},
      {"least_corner_px", [](auto& o) { o.least_corner_px = 0; }},
      {"shared_survey_factor", [](auto& o) { o.shared_survey_factor = 0.5; }},
      {"moved_tag_sigmas", [](auto& o) { o.moved_tag_sigmas = -1; }},
      {"relief_sigmas", [](auto& o) { o.relief_sigmas = -1; }},
      {"widest_relief_sigmas", [](auto& o) { o.widest_relief_sigmas = kInfinity; }},
      {"num_rounds", [](auto& o) { o.num_rounds = 0; }},
      {"start_range_px", [](auto& o) { o.start_range_px = 1; }},  // below the final range
      {"spare_range", [](auto& o) { o.spare_range = 0.5; }},
      {"shrink", [](auto& o) { o.shrink = 0; }},
      {"min_noise_px", [](auto& o) { o.min_noise_px = 0; }},
      {"matching.outlier_share", [](auto& o) { o.matching.outlier_share = 0; }},
  });
  [[maybe_unused]] const auto& [photographs, sigmas, offset, same] = ModelErrorOptions();
  ExpectCheckNamesEach<ModelErrorOptions>({
      {"min_photographs", [](auto& o) { o.min_photographs = 0; }},
      {"min_sigmas", [](auto& o) { o.min_sigmas = kNotANumber; }},
      {"min_offset_sigmas", [](auto& o) { o.min_offset_sigmas = -1; }},
      {"same_offset_share", [](auto& o) { o.same_offset_share = 2; }},
  });
}

TEST(RegistrationOptions, CheckNamesEachFieldOfThePrior) {
  [[maybe_unused]] const auto& [position,
                                position_share,
                                height,
                                height_share,
                                lookat,
                                lookat_share,
                                tape_scale,
                                roll,
                                view_angle,
                                aspect,
                                shift,
                                slide_shift,
                                digital_shift,
                                k1,
                                scale,
                                slide_aspect,
                                digital,
                                digital_aspect,
                                rounded_aspect,
                                prior_overclaim,
                                lock,
                                free] = PriorOptions();
  ExpectCheckNamesEach<PriorOptions>({
      {"sigma-position", [](auto& o) { o.position_m = 0; }},
      {"position_share", [](auto& o) { o.position_share = -1; }},
      {"sigma-height", [](auto& o) { o.height_m = kNotANumber; }},
      {"height_share", [](auto& o) { o.height_share = kNotANumber; }},
      {"sigma-lookat", [](auto& o) { o.lookat_m = kInfinity; }},
      {"lookat_share", [](auto& o) { o.lookat_share = kInfinity; }},
      {"tape_scale", [](auto& o) { o.tape_scale = 0; }},
      {"sigma-roll", [](auto& o) { o.roll_deg = 0; }},
      {"sigma-v", [](auto& o) { o.view_angle_share = 0; }},
      {"sigma-a", [](auto& o) { o.aspect_share = -1; }},
      {"sigma-shift", [](auto& o) { o.shift = 0; }},
      {"slide_shift", [](auto& o) { o.slide_shift = 0; }},
      {"digital_shift", [](auto& o) { o.digital_shift = kNotANumber; }},
      {"sigma-k1", [](auto& o) { o.k1 = kNotANumber; }},
      {"slide_scale_share", [](auto& o) { o.slide_scale_share = -1; }},
      {"slide_aspect_share", [](auto& o) { o.slide_aspect_share = kNotANumber; }},
      {"digital_aspect_share", [](auto& o) { o.digital_aspect_share = 0; }},
      {"rounded_aspect_share", [](auto& o) { o.rounded_aspect_share = -1; }},
      {"overclaim", [](auto& o) { o.overclaim = 0.5; }},
      {"option lock", [](auto& o) { o.lock = {"zoom"}; }},
      {"option free", [](auto& o) { o.free = {"zoom"}; }},
  });
}

TEST(RegistrationOptions, CheckNamesEachFieldOfTies) {
  [[maybe_unused]] const auto& [correlation, lead, peak, sigma, correlated, floor] =
      PatchMatchOptions();
  ExpectCheckNamesEach<PatchMatchOptions>({
      {"min_correlation", [](auto& o) { o.min_correlation = 1.1; }},
      {"min_lead", [](auto& o) { o.min_lead = kNotANumber; }},
      {"peak_texels", [](auto& o) { o.peak_texels = 0; }},
      {"max_sigma_texels", [](auto& o) { o.max_sigma_texels = 0; }},
      {"correlated_texels", [](auto& o) { o.correlated_texels = -1; }},
      {"floor_texels", [](auto& o) { o.floor_texels = 0; }},
  });
  [[maybe_unused]] const auto& [track_floor,
                                track_share,
                                track_angle,
                                gate_share,
                                gate_sigmas,
                                track_relief,
                                track_columns,
                                per_cell] = TrackOptions();
  ExpectCheckNamesEach<TrackOptions>({
      {"floor_px", [](auto& o) { o.floor_px = 0; }},
      {"scale_share", [](auto& o) { o.scale_share = -1; }},
      {"max_angle_deg", [](auto& o) { o.max_angle_deg = 90; }},
      {"gate_share", [](auto& o) { o.gate_share = 0; }},
      {"gate_sigmas", [](auto& o) { o.gate_sigmas = kNotANumber; }},
      {"relief_sigmas", [](auto& o) { o.relief_sigmas = 0; }},
      {"grid_columns", [](auto& o) { o.grid_columns = 0; }},
      {"most_per_cell", [](auto& o) { o.most_per_cell = 0; }},
  });
  [[maybe_unused]] const auto& [use_patches,
                                columns,
                                patch,
                                search,
                                share,
                                angle,
                                stars,
                                levels,
                                match,
                                tracks] = TieOptions();
  ExpectCheckNamesEach<TieOptions>({
      {"grid_columns", [](auto& o) { o.grid_columns = 0; }},
      {"patch_texels", [](auto& o) { o.patch_texels = 7; }},
      {"search_texels", [](auto& o) { o.search_texels = 0; }},
      {"least_resolution_share", [](auto& o) { o.least_resolution_share = -1; }},
      {"max_angle_deg", [](auto& o) { o.max_angle_deg = 90; }},
      {"num_stars", [](auto& o) { o.num_stars = 0; }},
      {"num_levels", [](auto& o) { o.num_levels = 0; }},
      {"match.min_lead", [](auto& o) { o.match.min_lead = -1; }},
      {"tracks.floor_px", [](auto& o) { o.tracks.floor_px = -1; }},
  });
  [[maybe_unused]] const auto& [pair_columns, least_share, pair_angle] = CovisibleOptions();
  ExpectCheckNamesEach<CovisibleOptions>({
      {"grid_columns", [](auto& o) { o.grid_columns = 0; }},
      {"least_share", [](auto& o) { o.least_share = 2; }},
      {"max_angle_deg", [](auto& o) { o.max_angle_deg = 90; }},
  });
  [[maybe_unused]] const auto& [program, folder, keypoints, pairs] = ColmapOptions();
  ExpectCheckNamesEach<ColmapOptions>({
      {"program names no program", [](auto& o) { o.program = ""; }},
      {"max_keypoints", [](auto& o) { o.max_keypoints = 0; }},
      {"pairs.least_share", [](auto& o) { o.pairs.least_share = -1; }},
  });
  [[maybe_unused]] const auto& [nats, miss, loss, relief, matches, join_share, place, kept, most] =
      TieSupportOptions();
  ExpectCheckNamesEach<TieSupportOptions>({
      {"match_nats", [](auto& o) { o.match_nats = 0; }},
      {"miss_nats", [](auto& o) { o.miss_nats = -1; }},
      {"loss_sigmas", [](auto& o) { o.loss_sigmas = 0; }},
      {"relief_sigmas", [](auto& o) { o.relief_sigmas = 0; }},
      {"least_matches_to_join", [](auto& o) { o.least_matches_to_join = 0; }},
      {"least_share_to_join", [](auto& o) { o.least_share_to_join = 2; }},
      {"least_agreeing_share_to_join", [](auto& o) { o.least_agreeing_share_to_join = -1; }},
      {"least_share_kept", [](auto& o) { o.least_share_kept = 2; }},
      {"most_matches", [](auto& o) { o.most_matches = 0; }},
  });
}

TEST(RegistrationOptions, CheckNamesEachFieldAndAsksEachPart) {
  [[maybe_unused]] const auto& [prior,
                                solutions,
                                readings,
                                overclaim,
                                displaced,
                                ties,
                                tie_support,
                                joint,
                                model_errors,
                                conflict,
                                verdict,
                                overrule,
                                independent,
                                width,
                                points,
                                use_ties,
                                use_colmap,
                                colmap,
                                tie_rounds,
                                keep,
                                together] = RegisterOptions();
  ExpectCheckNamesEach<RegisterOptions>({
      {"sigma-roll", [](auto& o) { o.prior.roll_deg = 0; }},
      {"solutions.hypotheses.width_cells", [](auto& o) { o.solutions.hypotheses.width_cells = 0; }},
      {"solutions.refine.matching.gate_deg",
       [](auto& o) { o.solutions.refine.matching.gate_deg = 0; }},
      {"solutions.score.noise_px", [](auto& o) { o.solutions.score.noise_px = 0; }},
      {"readings.wider_factor", [](auto& o) { o.readings.wider_factor = 0.5; }},
      {"overclaim.least_overclaim", [](auto& o) { o.overclaim.least_overclaim = 0; }},
      {"ties.grid_columns", [](auto& o) { o.ties.grid_columns = 0; }},
      {"colmap.max_keypoints", [](auto& o) { o.colmap.max_keypoints = 0; }},
      {"tie_support.match_nats", [](auto& o) { o.tie_support.match_nats = 0; }},
      {"num_tie_rounds", [](auto& o) { o.num_tie_rounds = 0; }},
      {"joint.own.edge_turn_sigmas", [](auto& o) { o.joint.own.edge_turn_sigmas = 0; }},
      {"model_errors.min_sigmas", [](auto& o) { o.model_errors.min_sigmas = -1; }},
      {"max_width_px", [](auto& o) { o.max_width_px = 63; }},
      {"solutions.distinct_distance_px",
       [](auto& o) { o.solutions.distinct_distance_px = kNotANumber; }},
      {"conflict.reach_share", [](auto& o) { o.conflict.reach_share = 0; }},
      {"verdict.min_margin_per_observation",
       [](auto& o) { o.verdict.min_margin_per_observation = -1; }},
      {"verdict.min_margin_nats", [](auto& o) { o.verdict.min_margin_nats = kInfinity; }},
      {"verdict.min_nats_per_observation",
       [](auto& o) { o.verdict.min_nats_per_observation = kNotANumber; }},
      {"verdict.min_nats", [](auto& o) { o.verdict.min_nats = -1; }},
      {"verdict.max_prior_sigmas", [](auto& o) { o.verdict.max_prior_sigmas = 0; }},
      {"verdict.max_prior_chi_squared", [](auto& o) { o.verdict.max_prior_chi_squared = 0; }},
      {"verdict.max_vertex_sigma_px", [](auto& o) { o.verdict.max_vertex_sigma_px = 0; }},
      {"verdict.min_expected_ties", [](auto& o) { o.verdict.min_expected_ties = 0; }},
      {"verdict.min_share_of_expected_ties",
       [](auto& o) { o.verdict.min_share_of_expected_ties = 1.1; }},
      {"s5: image_px",
       [](auto& o) {
         o.control_points = {{"s5", {kNotANumber, 1}, {1, 2, 3}}};
       }},
      {"point_in_world",
       [](auto& o) {
         o.control_points = {{"s5", {1, 1}, {1, 2, kInfinity}}};
       }},
      {"s5: sigma_px",
       [](auto& o) {
         o.control_points = {{"s5", {1, 1}, {1, 2, 3}, 0}};
       }},
      {"verdict.max_control_point_sigmas", [](auto& o) { o.verdict.max_control_point_sigmas = 0; }},
      {"accept and reject",
       [](auto& o) {
         o.overrule = {{"s5"}, {"s5"}};
       }},
  });
  RegisterOptions options;
  options.solutions.hypotheses.width_cells = 0;
  EXPECT_EQ(
      ThrownMessage([&] { options.Check(); }),
      "registration options: solutions.hypotheses.width_cells must be from 16 to 10000, not 0");
}

}  // namespace
}  // namespace groundglass
