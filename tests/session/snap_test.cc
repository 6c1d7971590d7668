// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/snap.h"

#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace groundglass {
namespace {

// Bright to the right of and below a corner, each pixel by the share of it that is; with grain.
Image8 PictureOfACorner(const Eigen::Vector2d& corner, bool is_edge, double noise) {
  Image8 picture(40, 30, 3);
  std::mt19937 random(5);
  std::normal_distribution<double> grain(0, noise);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double right = std::clamp(x + 1 - corner.x(), 0.0, 1.0);
      const double below = is_edge ? 1 : std::clamp(y + 1 - corner.y(), 0.0, 1.0);
      const double grey = 60 + 120 * right * below + (noise > 0 ? grain(random) : 0);
      std::fill_n(picture.At(x, y), 3, static_cast<uint8_t>(std::clamp(grey, 0.0, 255.0)));
    }
  }
  return picture;
}

TEST(SnapToPicture, FindsACornerToAFractionOfAPixel) {
  const Eigen::Vector2d corner(20.3, 14.6);
  for (const double noise : {0.0, 3.0}) {
    const auto found =
        SnapToPicture(PictureOfACorner(corner, false, noise), corner + Eigen::Vector2d(1.5, -1.2));
    ASSERT_TRUE(found);
    // A window that holds more of the arms than of the corner draws it inwards a little.
    EXPECT_LT((*found - corner).norm(), 0.35) << noise;
  }
}

TEST(SnapToPicture, GoesToTheNearestPlaceOfAnEdge) {
  const auto found = SnapToPicture(PictureOfACorner({20.3, 0}, true, 2), {22, 13.7});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x(), 20.3, 0.1);
  EXPECT_NEAR(found->y(), 13.7, 0.1);
}

TEST(SnapToPicture, LeavesAPinAloneWhereThereIsNothing) {
  EXPECT_FALSE(SnapToPicture(PictureOfACorner({20, 15}, false, 1), {7, 22}));
  EXPECT_FALSE(SnapToPicture(Image8(20, 20, 3, 90), {10, 10}));
  EXPECT_FALSE(SnapToPicture({}, {10, 10}));
  // Beyond the frame, too.
  EXPECT_FALSE(SnapToPicture(Image8(20, 20, 3, 90), {-50, 10}));
}

TEST(SnapOptions, AreChecked) {
  ExpectCheckNamesEach<SnapOptions>(
      {{"reach_px", [](SnapOptions& o) { o.reach_px = 0; }},
       {"window_px", [](SnapOptions& o) { o.window_px = 0.5; }},
       {"corner_share", [](SnapOptions& o) { o.corner_share = 2; }},
       {"least_contrast", [](SnapOptions& o) { o.least_contrast = 0; }}});
}

}  // namespace
}  // namespace groundglass
