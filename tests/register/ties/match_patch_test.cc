// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/match_patch.h"

#include "tests/register/ties/wall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace groundglass {
namespace {

constexpr int kPatch = 32;
constexpr int kSearch = 8;

// Light at places of a plane, a texel a quarter of a foot, the middle at (20, 10).
ImageF Sampled(int texels,
               const Eigen::Vector2d& shift_texels,
               const std::function<double(double, double)>& light) {
  ImageF image(texels, texels, 1);
  const double middle = 0.5 * (texels - 1);
  for (int row = 0; row < texels; ++row) {
    for (int column = 0; column < texels; ++column) {
      *image.At(column, row) =
          static_cast<float>(light(20 + 0.25 * (column - middle - shift_texels.x()),
                                   10 - 0.25 * (row - middle - shift_texels.y())));
    }
  }
  return image;
}

std::optional<PatchMatch> MatchShifted(const Eigen::Vector2d& shift_texels,
                                       const std::function<double(double, double)>& light,
                                       const std::function<double(double, double)>& other) {
  return MatchPatch(
      Sampled(kPatch, {0, 0}, light), Sampled(kPatch + 2 * kSearch, shift_texels, other), {});
}

TEST(MatchPatch, FindsPartsOfTexels) {
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(0, 0), {0.3, -0.45}, {5.5, -3.25}, {-6.1, 6.4}}) {
    const auto match = MatchShifted(shift, PlasterLight, PlasterLight);
    ASSERT_TRUE(match);
    EXPECT_LT((match->offset_texels - shift).norm(), 0.05) << shift.transpose();
    EXPECT_GT(match->correlation, 0.99);
  }
}

TEST(MatchPatch, NeitherBrighterNorPalerLightMatters) {
  const Eigen::Vector2d shift(2.3, -1.6);
  const auto match = MatchShifted(
      shift, PlasterLight, [](double x, double z) { return 0.2 + 0.4 * PlasterLight(x, z); });
  ASSERT_TRUE(match);
  EXPECT_LT((match->offset_texels - shift).norm(), 0.05);
}

TEST(MatchPatch, ItsErrorsAreAsLargeAsItSays) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0, 0.03);
  const auto noisy = [&](double x, double z) { return PlasterLight(x, z) + noise(random); };
  double squares = 0;
  int count = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Eigen::Vector2d shift(0.1 * (trial % 7), -0.13 * (trial % 5));
    const auto match = MatchShifted(shift, noisy, noisy);
    if (!match) continue;
    const Eigen::Vector2d error = match->offset_texels - shift;
    squares += error.dot(match->covariance.inverse() * error) / 2;
    ++count;
  }
  ASSERT_GT(count, 30);
  // Not more, and not ten times less.
  EXPECT_LT(squares / count, 1.2);
  EXPECT_GT(squares / count, 0.01);
}

TEST(MatchPatch, FindsNothingInAnotherWall) {
  EXPECT_FALSE(MatchShifted(
      {0, 0}, PlasterLight, [](double x, double z) { return PlasterLight(x + 137, z - 61); }));
}

TEST(MatchPatch, TakesNoPatternThatRepeatsItself) {
  const auto tiles = [](double x, double z) {
    const auto joint = [](double at) { return std::abs(at - std::round(at)) < 0.12 ? 0.3 : 0.0; };
    return 0.8 - joint(x) - joint(z);
  };
  EXPECT_FALSE(MatchShifted({0.4, 0.2}, tiles, tiles));
}

TEST(MatchPatch, TakesNoLineThatMaySlideAlongItself) {
  const auto cornice = [](double, double z) { return z > 10 ? 0.7 : 0.3; };
  EXPECT_FALSE(MatchShifted({0, 1.5}, cornice, cornice));
}

TEST(MatchPatch, TakesNothingWhereThereIsNothing) {
  const auto even = [](double, double) { return 0.5; };
  EXPECT_FALSE(MatchShifted({0, 0}, even, even));
}

}  // namespace
}  // namespace groundglass
