// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_lines.h"
#include "calibrate/calibrate_tags.h"
#include "calibrate/photograph_place.h"
#include "calibrate/slide_frame.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(CalibrateOptions, LinesNameEachField) {
  [[maybe_unused]] const auto& [center,
                                k1,
                                shortest,
                                of_direction,
                                in_all,
                                inflation,
                                angle,
                                rival,
                                a,
                                aspect_sigma,
                                aspect_share] = LinesOptions();
  ExpectCheckNamesEach<LinesOptions>({
      {"center_sigma", [](LinesOptions& o) { o.center_sigma = 0; }},
      {"k1_sigma", [](LinesOptions& o) { o.k1_sigma = kNotANumber; }},
      {"shortest_share", [](LinesOptions& o) { o.shortest_share = 0.9; }},
      {"min_segments_of_direction", [](LinesOptions& o) { o.min_segments_of_direction = 1; }},
      {"min_segments", [](LinesOptions& o) { o.min_segments = 0; }},
      {"inflation", [](LinesOptions& o) { o.inflation = 0.5; }},
      {"worst_view_angle_share", [](LinesOptions& o) { o.worst_view_angle_share = 0; }},
      {"aspect_sigma", [](LinesOptions& o) { o.aspect_sigma = -1; }},
      {"worst_aspect_share", [](LinesOptions& o) { o.worst_aspect_share = 0; }},
      {"rival_share", [](LinesOptions& o) { o.rival_share = -1; }},
      {"aspect", [](LinesOptions& o) { o.aspect = 0; }},
  });
}

TEST(CalibrateOptions, TagsNameEachField) {
  [[maybe_unused]] const auto& [noise,
                                angle,
                                shift,
                                k1,
                                aspect,
                                rms,
                                lens,
                                clear,
                                freedom,
                                near,
                                roll] = TagsOptions();
  ExpectCheckNamesEach<TagsOptions>({
      {"edge_noise_px", [](TagsOptions& o) { o.edge_noise_px = 0; }},
      {"view_angle_share", [](TagsOptions& o) { o.view_angle_share = 0; }},
      {"shift", [](TagsOptions& o) { o.shift = kInfinity; }},
      {"k1", [](TagsOptions& o) { o.k1 = 0; }},
      {"aspect_share", [](TagsOptions& o) { o.aspect_share = 0; }},
      {"max_rms_px", [](TagsOptions& o) { o.max_rms_px = 0; }},
      {"most_lens_sigmas", [](TagsOptions& o) { o.most_lens_sigmas = 0; }},
      {"clear_cost", [](TagsOptions& o) { o.clear_cost = -1; }},
      {"written_freedom", [](TagsOptions& o) { o.written_freedom = 0; }},
      {"same_place_sigmas", [](TagsOptions& o) { o.same_place_sigmas = -1; }},
      {"most_roll_deg", [](TagsOptions& o) { o.most_roll_deg = 200; }},
  });
}

TEST(CalibrateOptions, FramesNameEachField) {
  [[maybe_unused]] const auto& [share,
                                levels,
                                contrast,
                                deepest,
                                turn,
                                on,
                                square,
                                least,
                                most,
                                play,
                                aspect_sigma,
                                video_share,
                                slide,
                                blur,
                                a] = FrameOptions();
  ExpectCheckNamesEach<FrameOptions>({
      {"even_share", [](FrameOptions& o) { o.even_share = 2; }},
      {"even_levels", [](FrameOptions& o) { o.even_levels = -1; }},
      {"contrast_levels", [](FrameOptions& o) { o.contrast_levels = 0; }},
      {"deepest_share", [](FrameOptions& o) { o.deepest_share = 0.6; }},
      {"most_turn_deg", [](FrameOptions& o) { o.most_turn_deg = 90; }},
      {"least_on_line", [](FrameOptions& o) { o.least_on_line = 2; }},
      {"square_deg", [](FrameOptions& o) { o.square_deg = 0; }},
      {"least_aspect", [](FrameOptions& o) { o.least_aspect = 0; }},
      {"most_aspect", [](FrameOptions& o) { o.most_aspect = 0.5; }},
      {"mount_play", [](FrameOptions& o) { o.mount_play = 0; }},
      {"least_aspect_sigma", [](FrameOptions& o) { o.least_aspect_sigma = 0; }},
      {"video_aspect_share", [](FrameOptions& o) { o.video_aspect_share = -1; }},
      {"slide_aspect", [](FrameOptions& o) { o.slide_aspect = 0; }},
      {"blur_px", [](FrameOptions& o) { o.blur_px = -1; }},
      {"aspect", [](FrameOptions& o) { o.aspect = 0; }},
  });
}

TEST(CalibrateOptions, PlacesNameEachField) {
  [[maybe_unused]] const auto& [dilution,
                                position,
                                factor,
                                height,
                                compass,
                                declination_sigma,
                                level,
                                level_unknown,
                                declination,
                                geoid,
                                farthest] = PlaceOptions();
  ExpectCheckNamesEach<PlaceOptions>({
      {"per_dilution_m", [](PlaceOptions& o) { o.per_dilution_m = 0; }},
      {"position_m", [](PlaceOptions& o) { o.position_m = 0; }},
      {"height_factor", [](PlaceOptions& o) { o.height_factor = 0; }},
      {"height_m", [](PlaceOptions& o) { o.height_m = 0; }},
      {"compass_deg", [](PlaceOptions& o) { o.compass_deg = 0; }},
      {"declination_sigma_deg", [](PlaceOptions& o) { o.declination_sigma_deg = -1; }},
      {"level_deg", [](PlaceOptions& o) { o.level_deg = 0; }},
      {"level_if_unknown_deg", [](PlaceOptions& o) { o.level_if_unknown_deg = 0; }},
      {"declination", [](PlaceOptions& o) { o.declination_deg = 200; }},
      {"geoid", [](PlaceOptions& o) { o.geoid_m = 500; }},
      {"farthest_m", [](PlaceOptions& o) { o.farthest_m = 0; }},
  });
}

}  // namespace
}  // namespace groundglass
