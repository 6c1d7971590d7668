// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/support/spoilt_options.h"
#include "viewer/camera_path.h"
#include "viewer/film.h"
#include "viewer/montage.h"
#include "viewer/renderer.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(ViewerOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [mode, background, edges, samples, larger, along, bearing, height] =
      RenderOptions();
  ExpectCheckNamesEach<RenderOptions>({
      {"multisamples", [](auto& o) { o.multisamples = 2; }},
      {"supersampling", [](auto& o) { o.supersampling = 5; }},
      {"anisotropy", [](auto& o) { o.anisotropy = 0; }},
      {"sun_bearing_deg", [](auto& o) { o.sun_bearing_deg = kNotANumber; }},
      {"sun_height_deg", [](auto& o) { o.sun_height_deg = -1; }},
  });
  [[maybe_unused]] const auto& [page] = RendererOptions();
  ExpectCheckNamesEach<RendererOptions>({
      {"max_page_size_px", [](auto& o) { o.max_page_size_px = 0; }},
  });
  [[maybe_unused]] const auto& [width, tall, view, up, first] = OrbitOptions();
  ExpectCheckNamesEach<OrbitOptions>({
      {"width_px", [](auto& o) { o.width_px = 0; }},
      {"height_px", [](auto& o) { o.height_px = -1; }},
      {"view_angle_deg", [](auto& o) { o.view_angle_deg = 180; }},
      {"height_deg", [](auto& o) { o.height_deg = 90; }},
      {"first_bearing_deg", [](auto& o) { o.first_bearing_deg = kInfinity; }},
  });
  [[maybe_unused]] const auto& [fresh, near, stops, plain, finer, soft, grainy, light, of_photo] =
      MontageOptions();
  ExpectCheckNamesEach<MontageOptions>({
      {"same_place_share", [](auto& o) { o.same_place_share = 0; }},
      {"exposure_stops", [](auto& o) { o.exposure_stops = 11; }},
      {"plain_albedo", [](auto& o) { o.plain_albedo = kNotANumber; }},
      {"supersampling", [](auto& o) { o.supersampling = 0; }},
      {"blur_px", [](auto& o) { o.blur_px = -1; }},
      {"least_pixels", [](auto& o) { o.light.least_pixels = 0; }},
      {"most_squares", [](auto& o) { o.photo_grain.most_squares = 0; }},
  });
  [[maybe_unused]] const auto& [l1, l2, l3, l4, l5, l6, l7, l8, l9, l10, l11, l12, l13] =
      MontageLightOptions();
  ExpectCheckNamesEach<MontageLightOptions>({
      {"least_pixels", [](auto& o) { o.least_pixels = 0; }},
      {"border_px", [](auto& o) { o.border_px = -1; }},
      {"least_in_design", [](auto& o) { o.least_in_design = 0; }},
      {"darkest_code", [](auto& o) { o.darkest_code = 0; }},
      {"brightest_code", [](auto& o) { o.brightest_code = 256; }},
      {"bright_share", [](auto& o) { o.bright_share = 2; }},
      {"bright_albedo", [](auto& o) { o.bright_albedo = 0; }},
      {"same_material", [](auto& o) { o.same_material = 0; }},
      {"material_sigma", [](auto& o) { o.material_sigma = kInfinity; }},
      {"face_sigma", [](auto& o) { o.face_sigma = 0; }},
      {"expected_from_above", [](auto& o) { o.expected_from_above = 2; }},
      {"direction_sigma", [](auto& o) { o.direction_sigma = 0; }},
      {"least_share", [](auto& o) { o.least_share = 0; }},
  });
  [[maybe_unused]] const auto& [g1, g2, g3, g4, g5, g6, g7] = PhotoGrainOptions();
  ExpectCheckNamesEach<PhotoGrainOptions>({
      {"square_px", [](auto& o) { o.square_px = 7; }},
      {"blur_px", [](auto& o) { o.blur_px = 0; }},
      {"calm_share", [](auto& o) { o.calm_share = 0; }},
      {"most_between_tones", [](auto& o) { o.most_between_tones = 0; }},
      {"darkest_code", [](auto& o) { o.darkest_code = -1; }},
      {"brightest_code", [](auto& o) { o.brightest_code = 256; }},
      {"most_squares", [](auto& o) { o.most_squares = 0; }},
  });
  [[maybe_unused]] const auto& [rate, quality, ffmpeg] = FilmOptions();
  ExpectCheckNamesEach<FilmOptions>({
      {"frames_per_second", [](auto& o) { o.frames_per_second = kNotANumber; }},
      {"quality", [](auto& o) { o.quality = 52; }},
      {"ffmpeg", [](auto& o) { o.ffmpeg.clear(); }},
  });
}

}  // namespace
}  // namespace groundglass
