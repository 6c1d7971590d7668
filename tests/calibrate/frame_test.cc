// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/slide_frame.h"
#include "tests/support/draw_between.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace groundglass {
namespace {

using testing::HasSubstr;

constexpr int kMountWidth = 360;
constexpr int kMountHeight = 270;

// A scan of a mount as it was made.
struct Mount {
  Eigen::Vector2d center_px = {kMountWidth / 2.0, kMountHeight / 2.0};
  double width_px = 280;
  double height_px = 187;
  double turn_deg = 0;
  double corner_px = 8;  // radius of its round corners
  double border = 18;    // grey levels
  bool has_dark_part = false;
};

// How far a point lies inside the opening; pixels.
double Inside(const Mount& mount, const Eigen::Vector2d& point) {
  const double turn = mount.turn_deg * M_PI / 180;
  const Eigen::Vector2d off = point - mount.center_px;
  const Eigen::Vector2d own(std::abs(std::cos(turn) * off.x() + std::sin(turn) * off.y()),
                            std::abs(-std::sin(turn) * off.x() + std::cos(turn) * off.y()));
  const Eigen::Vector2d in_corner = own - Eigen::Vector2d(mount.width_px / 2 - mount.corner_px,
                                                          mount.height_px / 2 - mount.corner_px);
  if (in_corner.x() > 0 && in_corner.y() > 0) return mount.corner_px - in_corner.norm();
  return mount.corner_px - in_corner.maxCoeff();
}

// A picture of clouds, houses and ground in the mount, with blur of a pixel and noise.
Image8 Scan(const Mount& mount, std::mt19937_64& random) {
  const double phase = DrawBetween(random, 0, 6);
  Image8 grey(kMountWidth, kMountHeight, 1);
  for (int y = 0; y < kMountHeight; ++y) {
    for (int x = 0; x < kMountWidth; ++x) {
      const double share = std::clamp(Inside(mount, {x + 0.5, y + 0.5}) / 1.5 + 0.5, 0.0, 1.0);
      double picture = 140 + 50 * std::sin(x / 31.0 + phase) * std::cos(y / 23.0 - phase);
      const bool is_house = std::fmod(x / 40.0 + phase, 2) > 1.2 && y > 90;
      if (is_house) picture = 75 + 20 * std::sin(y / 3.0);
      // A night sky in a corner, as dark as the mount.
      if (mount.has_dark_part && x + y < 190) picture = mount.border + 5;
      const double noise = DrawBetween(random, -4, 4);
      *grey.At(x, y) = static_cast<uint8_t>(
          std::clamp(mount.border + share * (picture - mount.border) + noise, 0.0, 255.0));
    }
  }
  return grey;
}

Mount DrawMount(std::mt19937_64& random) {
  Mount mount;
  mount.width_px = DrawBetween(random, 240, 300);
  mount.height_px = mount.width_px / DrawBetween(random, 1.45, 1.53);
  mount.center_px += Eigen::Vector2d(DrawBetween(random, -15, 15), DrawBetween(random, -15, 15));
  mount.turn_deg = DrawBetween(random, -3, 3);
  mount.corner_px = DrawBetween(random, 0.5, 14);
  mount.border = DrawBetween(random, 4, 30);
  mount.has_dark_part = random() % 4 == 0;
  return mount;
}

TEST(SlideFrame, OfTwoHundredMountsMostAreFoundAndNoneWrongly) {
  std::mt19937_64 random(35);
  int num_found = 0, num_wrong = 0;
  double worst_px = 0, worst_deg = 0, squares_of_turn = 0;
  for (int i = 0; i < 200; ++i) {
    const Mount mount = DrawMount(random);
    const SlideFrame frame = FindSlideFrame(Scan(mount, random));
    if (!frame.is_found) continue;
    ++num_found;
    const double off_px = std::max({(frame.center_px - mount.center_px).norm(),
                                    std::abs(frame.width_px - mount.width_px) / 2,
                                    std::abs(frame.height_px - mount.height_px) / 2});
    const double off_deg = std::abs(frame.turn_deg - mount.turn_deg);
    if (off_px > 1 || off_deg > 0.2) {
      ++num_wrong;
      continue;
    }
    worst_px = std::max(worst_px, off_px);
    worst_deg = std::max(worst_deg, off_deg);
    squares_of_turn += std::pow(off_deg / frame.sigma_turn_deg, 2);
  }
  std::printf("200 mounts: %d found, %d wrongly; worst %.2f px, %.3f degrees; turn %.2f\n",
              num_found,
              num_wrong,
              worst_px,
              worst_deg,
              squares_of_turn / num_found);
  EXPECT_GE(num_found, 170);
  EXPECT_EQ(num_wrong, 0);
  EXPECT_LT(squares_of_turn / num_found, 3);
}

TEST(SlideFrame, APictureWithoutABorderHasNone) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 50; ++i) {
    Mount mount = DrawMount(random);
    mount.width_px = 3 * kMountWidth;
    mount.height_px = 3 * kMountHeight;
    EXPECT_FALSE(FindSlideFrame(Scan(mount, random)).is_found);
  }
}

TEST(SlideFrame, APrintsWhiteBorderIsABorder) {
  std::mt19937_64 random(9);
  Mount mount = DrawMount(random);
  mount.border = 240;
  mount.has_dark_part = false;
  const SlideFrame frame = FindSlideFrame(Scan(mount, random));
  ASSERT_TRUE(frame.is_found) << frame.reason;
  EXPECT_LT((frame.center_px - mount.center_px).norm(), 1);
}

TEST(SlideFrame, ASideOutsideOfTheScanAsksForTheAspect) {
  std::mt19937_64 random(10);
  Mount mount;
  mount.center_px.x() = 100;
  mount.turn_deg = 1;
  const Image8 scan = Scan(mount, random);
  EXPECT_THAT(FindSlideFrame(scan).reason, HasSubstr("--aspect"));
  FrameOptions options;
  options.aspect = mount.width_px / mount.height_px;
  const SlideFrame frame = FindSlideFrame(scan, options);
  ASSERT_TRUE(frame.is_found) << frame.reason;
  EXPECT_FALSE(frame.is_side_seen[0]);
  EXPECT_LT((frame.center_px - mount.center_px).norm(), 2);
}

TEST(SlideFrame, ATelevisionFrameHasItsPixelAspect) {
  // No size tells a camera's view from a slide's: both are within a deviation.
  const std::array<std::array<double, 3>, 4> frames = {
      {{640, 480, 4.0 / 3}, {720, 480, 1.3505}, {720, 576, 1.3675}, {768, 576, 4.0 / 3}}};
  for (const auto& [width, height, camera] : frames) {
    const auto video = FindVideoAspect(static_cast<int>(width), static_cast<int>(height));
    ASSERT_TRUE(video);
    EXPECT_LE(std::abs(camera - video->aspect), video->sigma) << width;
    EXPECT_LE(std::abs(1.5 - video->aspect), video->sigma) << width;
    EXPECT_LT(video->sigma, 0.09);
  }
  EXPECT_FALSE(FindVideoAspect(1500, 1000));
}

TEST(SlideFrame, ATelevisionFrameOfKnownKindHasItsAspect) {
  FrameOptions options;
  options.aspect = 16.0 / 9;
  const auto video = FindVideoAspect(720, 576, options);
  ASSERT_TRUE(video);
  EXPECT_DOUBLE_EQ(video->aspect, 16.0 / 9);
  EXPECT_LT(video->sigma, 0.01);
}

}  // namespace
}  // namespace groundglass
