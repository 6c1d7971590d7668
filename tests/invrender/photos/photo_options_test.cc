// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

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

}  // namespace
}  // namespace groundglass
