// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "invrender/tiles1988/tiles.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [charts,
                                photos,
                                pages,
                                memory,
                                blocks,
                                patches,
                                sharpness,
                                grain,
                                colour,
                                consistency,
                                seams,
                                blend,
                                dilate,
                                fill,
                                coverage,
                                stages,
                                match_colour,
                                reject_occluders,
                                fill_gaps,
                                as_photographed,
                                earlier_model,
                                on_face_mask] = BakeOptions();
  ExpectCheckNamesEach<BakeOptions>({
      {"charts.level_sine", [](auto& o) { o.charts.level_sine = 0; }},
      {"photos.frame_margin", [](auto& o) { o.photos.frame_margin = 0.5; }},
      {"photos.mount.dark_code", [](auto& o) { o.photos.mount.dark_code = -1; }},
      {"pages.bits", [](auto& o) { o.pages.bits = 10; }},
      {"memory.max_memory_mb", [](auto& o) { o.memory.max_memory_mb = -1; }},
      {"blocks.black", [](auto& o) { o.blocks.black = 0; }},
      {"patches.max_views", [](auto& o) { o.patches.max_views = 1; }},
      {"sharpness.alike", [](auto& o) { o.sharpness.alike = 2; }},
      {"grain.dark", [](auto& o) { o.grain.dark = 0; }},
      {"colour.even_light", [](auto& o) { o.colour.even_light = 0; }},
      {"consistency.agreeing", [](auto& o) { o.consistency.agreeing = 0; }},
      {"consistency.histogram.bins_per_unit",
       [](auto& o) { o.consistency.histogram.bins_per_unit = 0; }},
      {"seams.max_data_cost", [](auto& o) { o.seams.max_data_cost = 0; }},
      {"blend.ramp_px", [](auto& o) { o.blend.ramp_px = 0; }},
      {"blend.sampling.max_taps", [](auto& o) { o.blend.sampling.max_taps = 0; }},
      {"dilate.slit_texels", [](auto& o) { o.dilate.slit_texels = 0; }},
      {"fill.radius_texels", [](auto& o) { o.fill.radius_texels = 0; }},
      {"coverage.viewpoint.eye_level_ft", [](auto& o) { o.coverage.viewpoint.eye_level_ft = 0; }},
      {"earlier_model.same_normal_cosine", [](auto& o) { o.earlier_model.same_normal_cosine = 2; }},
      {"stages.smooth_seams", [](auto& o) { o.stages.smooth_seams = nullptr; }},
  });
  [[maybe_unused]] const auto& [downsample] = TileOptions();
  ExpectCheckNamesEach<TileOptions>({
      {"downsample", [](auto& o) { o.downsample = 2; }},
  });
}

TEST(InvrenderOptions, StagesCheckNamesEachField) {
  [[maybe_unused]] const auto& [estimate_colour,
                                measure_sharpness,
                                measure_consistency,
                                choose_blocks,
                                smooth_seams,
                                smooth_grain,
                                fill_gaps] = BakeStages();
  ExpectCheckNamesEach<BakeStages>({
      {"estimate_colour", [](auto& o) { o.estimate_colour = nullptr; }},
      {"measure_sharpness", [](auto& o) { o.measure_sharpness = nullptr; }},
      {"measure_consistency", [](auto& o) { o.measure_consistency = nullptr; }},
      {"choose_blocks", [](auto& o) { o.choose_blocks = nullptr; }},
      {"smooth_seams", [](auto& o) { o.smooth_seams = nullptr; }},
      {"smooth_grain", [](auto& o) { o.smooth_grain = nullptr; }},
      {"fill_gaps", [](auto& o) { o.fill_gaps = nullptr; }},
  });
}

TEST(InvrenderOptions, ChartCheckNamesEachField) {
  [[maybe_unused]] const auto& [coplanar_sine, coplanar_share, level_sine] = ChartOptions();
  ExpectCheckNamesEach<ChartOptions>({
      {"coplanar_sine", [](auto& o) { o.coplanar_sine = -1; }},
      {"coplanar_share", [](auto& o) { o.coplanar_share = -1; }},
      {"level_sine", [](auto& o) { o.level_sine = -1; }},
  });
}

TEST(InvrenderOptions, PageCheckNamesEachField) {
  [[maybe_unused]] const auto& [texel_size,
                                kept_share,
                                texel_px,
                                max_page_texels,
                                gutter_texels,
                                bits] = PageOptions();
  ExpectCheckNamesEach<PageOptions>({
      {"texel_size", [](auto& o) { o.texel_size = kNotANumber; }},
      {"kept_share", [](auto& o) { o.kept_share = 2; }},
      {"texel_px", [](auto& o) { o.texel_px = 0; }},
      {"max_page_texels", [](auto& o) { o.max_page_texels = 63; }},
      {"gutter_texels", [](auto& o) { o.gutter_texels = 0; }},
      {"bits", [](auto& o) { o.bits = 10; }},
  });
}

TEST(InvrenderOptions, MountCheckNamesEachField) {
  [[maybe_unused]] const auto& [dark_code, dark_share, deepest_share, widening_share] =
      MountOptions();
  ExpectCheckNamesEach<MountOptions>({
      {"dark_code", [](auto& o) { o.dark_code = -1; }},
      {"dark_share", [](auto& o) { o.dark_share = 2; }},
      {"deepest_share", [](auto& o) { o.deepest_share = 1; }},
      {"widening_share", [](auto& o) { o.widening_share = -1; }},
  });
}

TEST(InvrenderOptions, BorderCheckNamesEachField) {
  [[maybe_unused]] const auto& [crease_bonus_px, crease_depth_share] = BorderOptions();
  ExpectCheckNamesEach<BorderOptions>({
      {"crease_bonus_px", [](auto& o) { o.crease_bonus_px = -1; }},
      {"crease_depth_share", [](auto& o) { o.crease_depth_share = -1; }},
  });
}

TEST(InvrenderOptions, QualityCheckNamesEachField) {
  [[maybe_unused]] const auto& [border_clear_px,
                                border_ramp_px,
                                least_at_border,
                                least_at_frame,
                                frame_ramp_share] = QualityOptions();
  ExpectCheckNamesEach<QualityOptions>({
      {"border_clear_px", [](auto& o) { o.border_clear_px = -1; }},
      {"border_ramp_px", [](auto& o) { o.border_ramp_px = -9; }},
      {"least_at_border", [](auto& o) { o.least_at_border = 0; }},
      {"least_at_frame", [](auto& o) { o.least_at_frame = -1; }},
      {"frame_ramp_share", [](auto& o) { o.frame_ramp_share = 0; }},
  });
}

TEST(InvrenderOptions, EarlierModelCheckNamesEachField) {
  [[maybe_unused]] const auto& [same_normal_cosine] = EarlierModelOptions();
  ExpectCheckNamesEach<EarlierModelOptions>({
      {"same_normal_cosine", [](auto& o) { o.same_normal_cosine = 2; }},
  });
}

TEST(InvrenderOptions, PhotoCheckNamesEachField) {
  [[maybe_unused]] const auto& [border_margin_px,
                                frame_margin,
                                step_inside_px,
                                detect_mount,
                                mount,
                                borders,
                                quality] = PhotoOptions();
  ExpectCheckNamesEach<PhotoOptions>({
      {"border_margin_px", [](auto& o) { o.border_margin_px = kInfinity; }},
      {"frame_margin", [](auto& o) { o.frame_margin = 0.5; }},
      {"step_inside_px", [](auto& o) { o.step_inside_px = 2; }},
      {"mount.dark_share", [](auto& o) { o.mount.dark_share = -1; }},
      {"borders.crease_bonus_px", [](auto& o) { o.borders.crease_bonus_px = -1; }},
      {"quality.least_at_border", [](auto& o) { o.quality.least_at_border = 0; }},
  });
}

TEST(InvrenderOptions, MemoryCheckNamesEachField) {
  [[maybe_unused]] const auto& [max_memory_mb,
                                photo_share,
                                few_photos,
                                max_texel_scale,
                                max_halvings,
                                worth_dropping,
                                worth_halving,
                                mask_estimate_factor] = MemoryOptions();
  ExpectCheckNamesEach<MemoryOptions>({
      {"max_memory_mb", [](auto& o) { o.max_memory_mb = -1; }},
      {"photo_share", [](auto& o) { o.photo_share = 2; }},
      {"few_photos", [](auto& o) { o.few_photos = 0; }},
      {"max_texel_scale", [](auto& o) { o.max_texel_scale = 0; }},
      {"max_halvings", [](auto& o) { o.max_halvings = -1; }},
      {"worth_dropping", [](auto& o) { o.worth_dropping = 0; }},
      {"worth_halving", [](auto& o) { o.worth_halving = 0; }},
      {"mask_estimate_factor", [](auto& o) { o.mask_estimate_factor = 0; }},
  });
}

TEST(InvrenderOptions, PatchCheckNamesEachField) {
  [[maybe_unused]] const auto& [max_patches, max_views, max_coarseness, clear_px] = PatchOptions();
  ExpectCheckNamesEach<PatchOptions>({
      {"max_patches", [](auto& o) { o.max_patches = 0; }},
      {"max_views", [](auto& o) { o.max_views = 1; }},
      {"max_coarseness", [](auto& o) { o.max_coarseness = 0; }},
      {"clear_px", [](auto& o) { o.clear_px = -1; }},
  });
}

TEST(InvrenderOptions, SamplingCheckNamesEachField) {
  [[maybe_unused]] const auto& [max_taps, one_tap_px, max_anisotropy, bicubic_taps] =
      SamplingOptions();
  ExpectCheckNamesEach<SamplingOptions>({
      {"max_taps", [](auto& o) { o.max_taps = 0; }},
      {"one_tap_px", [](auto& o) { o.one_tap_px = 0; }},
      {"max_anisotropy", [](auto& o) { o.max_anisotropy = 0; }},
      {"bicubic_taps", [](auto& o) { o.bicubic_taps = -1; }},
  });
}

TEST(InvrenderOptions, ViewpointCheckNamesEachField) {
  [[maybe_unused]] const auto& [eye_level_ft, turns_deg, distances, least_cosine] =
      ViewpointOptions();
  ExpectCheckNamesEach<ViewpointOptions>({
      {"eye_level_ft", [](auto& o) { o.eye_level_ft = 0; }},
      {"turns_deg", [](auto& o) { o.turns_deg[6] = 100; }},
      {"distances", [](auto& o) { o.distances[2] = 0; }},
      {"least_cosine", [](auto& o) { o.least_cosine = 2; }},
  });
}

TEST(InvrenderOptions, CoverageCheckNamesEachField) {
  [[maybe_unused]] const auto& [least_missing_share, viewpoint] = CoverageOptions();
  ExpectCheckNamesEach<CoverageOptions>({
      {"least_missing_share", [](auto& o) { o.least_missing_share = -1; }},
      {"viewpoint.least_cosine", [](auto& o) { o.viewpoint.least_cosine = -1; }},
  });
}

TEST(InvrenderOptions, BlockCheckNamesEachField) {
  [[maybe_unused]] const auto& [black, burnt, clear_px] = BlockOptions();
  ExpectCheckNamesEach<BlockOptions>({
      {"black", [](auto& o) { o.black = 0; }},
      {"burnt", [](auto& o) { o.burnt = 2; }},
      {"clear_px", [](auto& o) { o.clear_px = -1; }},
  });
}

TEST(InvrenderOptions, SharpnessCheckNamesEachField) {
  [[maybe_unused]] const auto& [alike,
                                ordinary_blur_px2,
                                ordinary_weight,
                                least_blur_px2,
                                doubtful,
                                certain,
                                detail_floor] = SharpnessOptions();
  ExpectCheckNamesEach<SharpnessOptions>({
      {"alike", [](auto& o) { o.alike = -1; }},
      {"ordinary_blur_px2", [](auto& o) { o.ordinary_blur_px2 = -1; }},
      {"ordinary_weight", [](auto& o) { o.ordinary_weight = -1; }},
      {"least_blur_px2", [](auto& o) { o.least_blur_px2 = -1; }},
      {"doubtful", [](auto& o) { o.doubtful = kNotANumber; }},
      {"certain", [](auto& o) { o.certain = 2; }},
      {"detail_floor", [](auto& o) { o.detail_floor = -1; }},
  });
}

TEST(InvrenderOptions, GrainCheckNamesEachField) {
  [[maybe_unused]] const auto& [grain_agreement,
                                detail_agreement,
                                calm_one_in,
                                few_patches,
                                fewest_patches,
                                calm_quantile,
                                prior_patches,
                                dark,
                                vignetting_at] = GrainOptions();
  ExpectCheckNamesEach<GrainOptions>({
      {"grain_agreement", [](auto& o) { o.grain_agreement = -2; }},
      {"detail_agreement", [](auto& o) { o.detail_agreement = 0.1; }},
      {"calm_one_in", [](auto& o) { o.calm_one_in = -1; }},
      {"few_patches", [](auto& o) { o.few_patches = -1; }},
      {"fewest_patches", [](auto& o) { o.fewest_patches = -1; }},
      {"calm_quantile", [](auto& o) { o.calm_quantile = -1; }},
      {"prior_patches", [](auto& o) { o.prior_patches = -1; }},
      {"dark", [](auto& o) { o.dark = -1; }},
      {"vignetting_at", [](auto& o) { o.vignetting_at = -1; }},
  });
}

TEST(InvrenderOptions, ColourCheckNamesEachField) {
  [[maybe_unused]] const auto& [even_light,
                                fewest_shared,
                                enough_for_pairs,
                                enough_of_pair,
                                most_shared,
                                vignetting_scale,
                                vignetting_rounds,
                                vignetting_prior,
                                many_blocks,
                                gain_scales,
                                gain_prior,
                                light_rounds,
                                few_blocks,
                                enough_for_light,
                                most_uneven] = ColourOptions();
  ExpectCheckNamesEach<ColourOptions>({
      {"even_light", [](auto& o) { o.even_light = -1; }},
      {"fewest_shared", [](auto& o) { o.fewest_shared = -1; }},
      {"enough_for_pairs", [](auto& o) { o.enough_for_pairs = -1; }},
      {"enough_of_pair", [](auto& o) { o.enough_of_pair = -1; }},
      {"most_shared", [](auto& o) { o.most_shared = -1; }},
      {"vignetting_scale", [](auto& o) { o.vignetting_scale = -1; }},
      {"vignetting_rounds", [](auto& o) { o.vignetting_rounds = -1; }},
      {"vignetting_prior", [](auto& o) { o.vignetting_prior = -1; }},
      {"many_blocks", [](auto& o) { o.many_blocks = -1; }},
      {"gain_scales", [](auto& o) { o.gain_scales[10] = 0; }},
      {"gain_prior", [](auto& o) { o.gain_prior = -1; }},
      {"light_rounds", [](auto& o) { o.light_rounds = -1; }},
      {"few_blocks", [](auto& o) { o.few_blocks = -1; }},
      {"enough_for_light", [](auto& o) { o.enough_for_light = -1; }},
      {"most_uneven", [](auto& o) { o.most_uneven = -1; }},
  });
}

TEST(InvrenderOptions, HistogramCheckNamesEachField) {
  [[maybe_unused]] const auto& [bins_per_unit,
                                fewest_counts,
                                ordinary_share,
                                unseen_share,
                                max_negative_log_likelihood] = HistogramOptions();
  ExpectCheckNamesEach<HistogramOptions>({
      {"bins_per_unit", [](auto& o) { o.bins_per_unit = -1; }},
      {"fewest_counts", [](auto& o) { o.fewest_counts = -1; }},
      {"ordinary_share", [](auto& o) { o.ordinary_share = -1; }},
      {"unseen_share", [](auto& o) { o.unseen_share = -1; }},
      {"max_negative_log_likelihood", [](auto& o) { o.max_negative_log_likelihood = -1; }},
  });
}

TEST(InvrenderOptions, ConsistencyCheckNamesEachField) {
  [[maybe_unused]] const auto& [ordinary_difference,
                                max_inconsistency,
                                agreeing,
                                histogram_weight,
                                blur_weight,
                                vote_unevenness,
                                even_light_preference,
                                cost_radius,
                                inconsistency_radius,
                                consensus_radius,
                                majority,
                                fewest_to_compare,
                                disputed_weight,
                                histogram] = ConsistencyOptions();
  ExpectCheckNamesEach<ConsistencyOptions>({
      {"ordinary_difference", [](auto& o) { o.ordinary_difference = -1; }},
      {"max_inconsistency", [](auto& o) { o.max_inconsistency = -1; }},
      {"agreeing", [](auto& o) { o.agreeing = -1; }},
      {"histogram_weight", [](auto& o) { o.histogram_weight = -1; }},
      {"blur_weight", [](auto& o) { o.blur_weight = -1; }},
      {"vote_unevenness", [](auto& o) { o.vote_unevenness = -1; }},
      {"even_light_preference", [](auto& o) { o.even_light_preference = -1; }},
      {"cost_radius", [](auto& o) { o.cost_radius = -1; }},
      {"inconsistency_radius", [](auto& o) { o.inconsistency_radius = -1; }},
      {"consensus_radius", [](auto& o) { o.consensus_radius = -1; }},
      {"majority", [](auto& o) { o.majority = -1; }},
      {"fewest_to_compare", [](auto& o) { o.fewest_to_compare = -1; }},
      {"disputed_weight", [](auto& o) { o.disputed_weight = -1; }},
      {"histogram.fewest_counts", [](auto& o) { o.histogram.fewest_counts = 0; }},
  });
}

TEST(InvrenderOptions, SeamCheckNamesEachField) {
  [[maybe_unused]] const auto& [max_data_cost, seam_cost, difference_cost, max_difference] =
      SeamOptions();
  ExpectCheckNamesEach<SeamOptions>({
      {"max_data_cost", [](auto& o) { o.max_data_cost = -1; }},
      {"seam_cost", [](auto& o) { o.seam_cost = -1; }},
      {"difference_cost", [](auto& o) { o.difference_cost = -1; }},
      {"max_difference", [](auto& o) { o.max_difference = -1; }},
  });
}

TEST(InvrenderOptions, BlendCheckNamesEachField) {
  [[maybe_unused]] const auto& [across_seams,
                                clear_px,
                                ramp_start_px,
                                ramp_px,
                                least_border_weight,
                                enough_chosen,
                                others_weight,
                                least_consistency,
                                negligible,
                                good_weight,
                                reach_beyond_px,
                                farthest_reach,
                                sampling] = BlendOptions();
  ExpectCheckNamesEach<BlendOptions>({
      {"clear_px", [](auto& o) { o.clear_px = -1; }},
      {"ramp_start_px", [](auto& o) { o.ramp_start_px = kInfinity; }},
      {"ramp_px", [](auto& o) { o.ramp_px = -1; }},
      {"least_border_weight", [](auto& o) { o.least_border_weight = -1; }},
      {"enough_chosen", [](auto& o) { o.enough_chosen = -1; }},
      {"others_weight", [](auto& o) { o.others_weight = -1; }},
      {"least_consistency", [](auto& o) { o.least_consistency = -1; }},
      {"negligible", [](auto& o) { o.negligible = -1; }},
      {"good_weight", [](auto& o) { o.good_weight = -1; }},
      {"reach_beyond_px", [](auto& o) { o.reach_beyond_px = -1; }},
      {"farthest_reach", [](auto& o) { o.farthest_reach = -1; }},
      {"sampling.one_tap_px", [](auto& o) { o.sampling.one_tap_px = 3; }},
  });
}

TEST(InvrenderOptions, DilateCheckNamesEachField) {
  [[maybe_unused]] const auto& [slit_texels] = DilateOptions();
  ExpectCheckNamesEach<DilateOptions>({
      {"slit_texels", [](auto& o) { o.slit_texels = -1; }},
  });
}

TEST(InvrenderOptions, FillCheckNamesEachField) {
  [[maybe_unused]] const auto& [radius_texels] = FillOptions();
  ExpectCheckNamesEach<FillOptions>({
      {"radius_texels", [](auto& o) { o.radius_texels = -1; }},
  });
}

}  // namespace
}  // namespace groundglass
