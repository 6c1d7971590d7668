// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_lines.h"
#include "scene/srgb.h"
#include "scene/view_tag.h"
#include "tests/support/draw_between.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 640;
constexpr int kHeight = 427;

// Linear light of a house 20 wide, 12 deep and 9 high with rows of windows, on grey ground.
double LightAlong(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d size(20, 12, 9);
  double nearest = 1e9;
  double light = direction.z() > 0 ? 0.9 : 0.3;
  for (int axis = 0; axis < 3; ++axis) {
    const double plane = direction[axis] > 0 ? 0 : size[axis];
    const double t = (plane - from[axis]) / direction[axis];
    if (!(t > 0) || t > nearest) continue;
    const Eigen::Vector3d at = from + t * direction;
    bool is_on_box = true;
    for (int other = 0; other < 3; ++other) {
      is_on_box = is_on_box && (other == axis || (at[other] > 0 && at[other] < size[other]));
    }
    if (!is_on_box) continue;
    nearest = t;
    const double along = std::fmod(at[axis == 0 ? 1 : 0], 2.0);
    const double up = std::fmod(at.z(), 3.0);
    const bool is_window = axis != 2 && along > 0.5 && along < 1.5 && up > 0.9 && up < 2.4;
    light = (axis == 0 ? 0.5 : 0.35) * (is_window ? 0.15 : 1);
  }
  return light;
}

// Four rays a pixel, noise of two grey levels.
Image8 Photograph(const ViewTag& tag, uint64_t seed) {
  const Camera camera = CameraFromTag(tag, kWidth, kHeight);
  std::mt19937_64 random(seed);
  Image8 grey(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      double light = 0;
      for (const double dx : {0.25, 0.75}) {
        for (const double dy : {0.25, 0.75}) {
          light += LightAlong(camera.PositionInWorld(), UnprojectToWorld(camera, {x + dx, y + dy}));
        }
      }
      const int noise = static_cast<int>(random() % 9) - 4;
      const int code = Srgb8FromLinear(static_cast<float>(light / 4)) + noise;
      *grey.At(x, y) = static_cast<uint8_t>(std::clamp(code, 0, 255));
    }
  }
  return grey;
}

// From aside of a corner, looking at the house's middle and a little up.
ViewTag CornerView(std::mt19937_64& random) {
  ViewTag tag;
  tag.view_angle_deg = DrawBetween(random, 40, 70);
  const double distance = 24 / std::tan(tag.view_angle_deg / 2 * M_PI / 180);
  const double bearing = DrawBetween(random, 0.5, 1.1);
  tag.position_in_site = {
      10 + 0.75 * distance * std::sin(bearing), 6 + 0.75 * distance * std::cos(bearing), 1.6};
  tag.position_in_site.y() -= 12;  // `site` counts south: the house lies from 0 to -12
  tag.lookat_in_site = {10, -6, DrawBetween(random, 4, 8)};
  tag.aspect = static_cast<double>(kWidth) / kHeight;
  tag.roll_deg = DrawBetween(random, -3, 3);
  tag.shift_x = DrawBetween(random, -0.01, 0.01);
  tag.shift_y = DrawBetween(random, -0.01, 0.01);
  tag.k1 = DrawBetween(random, -0.1, 0.05);
  return tag;
}

TEST(CalibrateLines, CornersOfAHouseTellItsCameraWithinItsDeviations) {
  std::mt19937_64 random(20);
  constexpr int kTrials = 6;
  int num_found = 0, num_good = 0;
  double squares_of_v = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ViewTag truth = CornerView(random);
    const LinesResult found = CalibrateLines(Photograph(truth, 7), {}, 1);
    if (!found.is_found) continue;
    ++num_found;
    const auto deviations = [](double value, double exact, double sigma) {
      return std::abs(value - exact) / sigma;
    };
    const double of_v =
        deviations(found.view_angle_deg, truth.view_angle_deg, found.sigma_view_angle_deg);
    EXPECT_LT(of_v, 4) << found.view_angle_deg << " for " << truth.view_angle_deg;
    EXPECT_LT(deviations(found.roll_deg, truth.roll_deg, found.sigma_roll_deg), 4)
        << found.roll_deg << " for " << truth.roll_deg;
    EXPECT_LT(deviations(found.k1, truth.k1, found.sigma_k1), 4) << found.k1 << " for " << truth.k1;
    EXPECT_LT(deviations(found.shift_x, truth.shift_x, found.sigma_shift_x), 4);
    EXPECT_LT(deviations(found.shift_y, truth.shift_y, found.sigma_shift_y), 4);
    if (found.sigma_view_angle_deg < 0.04 * truth.view_angle_deg) ++num_good;
    squares_of_v += of_v * of_v;
  }
  EXPECT_GE(num_found, 5);
  EXPECT_GE(num_good, 2);
  EXPECT_LT(squares_of_v / num_found, 3);
}

TEST(CalibrateLines, AWallFromTheFrontLeavesTheViewAngleOpen) {
  ViewTag tag;
  tag.position_in_site = {10, 25, 4.5};
  tag.lookat_in_site = {10, 0, 4.5};
  tag.view_angle_deg = 40;
  const LinesResult found = CalibrateLines(Photograph(tag, 3));
  EXPECT_FALSE(found.is_found);
  EXPECT_THAT(found.reason, HasSubstr("the view angle open"));
  EXPECT_TRUE(KeysOfLines(found, {}).empty());
}

TEST(CalibrateLines, APictureWithoutLinesIsSaidToHaveNone) {
  std::mt19937_64 random(3);
  Image8 noise(200, 100, 1);
  for (uint8_t& value : noise.values) value = static_cast<uint8_t>(random() % 256);
  const LinesResult found = CalibrateLines(noise);
  EXPECT_FALSE(found.is_found);
  EXPECT_THAT(found.reason, HasSubstr("too few lines"));
}

}  // namespace
}  // namespace groundglass
