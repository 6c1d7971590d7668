// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/support/spoilt_options.h"
#include "viewer/camera_path.h"
#include "viewer/film.h"
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
  [[maybe_unused]] const auto& [rate, quality, ffmpeg] = FilmOptions();
  ExpectCheckNamesEach<FilmOptions>({
      {"frames_per_second", [](auto& o) { o.frames_per_second = kNotANumber; }},
      {"quality", [](auto& o) { o.quality = 52; }},
      {"ffmpeg", [](auto& o) { o.ffmpeg.clear(); }},
  });
}

}  // namespace
}  // namespace groundglass
