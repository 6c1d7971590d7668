// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "invrender/bake_output.h"
#include "invrender/select/colour_histogram.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace groundglass {
namespace {

const Paint kHalfWaves = [](int, const Eigen::Vector3d& point) {
  return Eigen::Array3f(0.5f * Waves(point));
};

// How much brighter than the truth the texels of each photograph are, log units; NaN where it has
// hardly any.
std::vector<Eigen::Array3f> MeanErrors(const TexturedModel& model, int face, int num_photos) {
  std::vector<Eigen::Array3f> sums(num_photos, Eigen::Array3f::Zero());
  std::vector<int> counts(num_photos, 0);
  for (const PlacedTexel& texel : TexelsOf(model, face)) {
    if (texel.source == kProvenanceNone || texel.source == kProvenanceFilled) continue;
    sums[texel.source - 1] += (texel.radiance / (0.5f * Waves(texel.point_in_world))).log();
    ++counts[texel.source - 1];
  }
  for (int i = 0; i < num_photos; ++i) {
    sums[i] = counts[i] < 500 ? Eigen::Array3f(Eigen::Array3f::Constant(NAN))
                              : Eigen::Array3f(sums[i] / static_cast<float>(counts[i]));
  }
  return sums;
}

TEST(MatchColour, ExposureAndWhiteBalanceAreEvenedOutAlongAChainOfPhotographs) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 60, 0, 12);
  const Eigen::Array3f gains[4] = {
      {1, 1, 1}, {0.6f, 0.55f, 0.5f}, {1.3f, 1.25f, 1.4f}, {0.8f, 0.9f, 0.7f}};
  std::vector<BakePhotograph> photographs;
  for (int i = 0; i < 4; ++i) {
    const Camera camera = LookAt({10 + 13.0 * i, -24, 6}, {10 + 13.0 * i, 0, 6}, 320, 200, 240);
    photographs.push_back(PhotographPainted(
        model,
        camera,
        kHalfWaves,
        folder.path(),
        "s" + std::to_string(i + 1),
        [&](const Eigen::Array3f& radiance, int, int) { return radiance * gains[i]; }));
  }
  const BakeResult result = BakeTextures(model, photographs);
  const std::vector<Eigen::Array3f> errors = MeanErrors(result.model, wall, 4);
  int num_compared = 0;
  for (int i = 1; i < 4; ++i) {
    if (std::isnan(errors[i][0])) continue;  // seams moved off it
    EXPECT_LT((errors[i] - errors[0]).abs().maxCoeff(), 0.03f) << i;
    ++num_compared;
  }
  EXPECT_GE(num_compared, 2);
  BakeOptions options;
  options.match_colour = false;
  options.stages.smooth_seams = [](auto&&...) {};
  options.blend.across_seams = false;
  const std::vector<Eigen::Array3f> raw =
      MeanErrors(BakeTextures(model, photographs, options).model, wall, 4);
  EXPECT_NEAR(raw[1][0], std::log(0.6), 0.02);
}

TEST(MatchColour, VignettingIsFoundFromOverlaps) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 60, 0, 30);
  std::vector<BakePhotograph> photographs;
  for (int i = 0; i < 6; ++i) {
    const int row = i / 3;
    const Eigen::Vector3d target(12 + 18.0 * (i % 3), 0, 9 + 12.0 * row);
    const Camera camera = LookAt(target - Eigen::Vector3d(0, 30, 0), target, 320, 200, 260);
    photographs.push_back(PhotographPainted(
        model,
        camera,
        kHalfWaves,
        folder.path(),
        "s" + std::to_string(i + 1),
        [&](const Eigen::Array3f& radiance, int x, int y) {
          const double r2 =
              (std::pow(x - 159.5, 2) + std::pow(y - 99.5, 2)) / (160.0 * 160 + 100 * 100);
          return Eigen::Array3f(radiance * static_cast<float>(std::exp(-0.5 * r2)));
        }));
  }
  const auto spread = [&](const BakeOptions& options) {
    double sum = 0;
    double squares = 0;
    long count = 0;
    for (const PlacedTexel& texel :
         TexelsOf(BakeTextures(model, photographs, options).model, wall)) {
      if (texel.source == 0) continue;
      const double error = std::log(texel.radiance[1] / (0.5 * Waves(texel.point_in_world)[1]));
      sum += error;
      squares += error * error;
      ++count;
    }
    return std::sqrt(squares / count - sum / count * sum / count);
  };
  BakeOptions raw;
  raw.match_colour = false;
  const double before = spread(raw);
  EXPECT_GT(before, 0.05);
  EXPECT_LT(spread({}), before / 2);
}

// Photographs of one wall; in each, a dark post stands somewhere else before it.
TEST(RejectOccluders, WhatOnePhotographOfThreeShowsIsNotTexture) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 24, 0, 12);
  std::vector<BakePhotograph> photographs;
  for (int i = 0; i < 3; ++i) {
    const Camera camera = LookAt({6.0 + 6 * i, -26, 6}, {12, 0, 6}, 400, 260, 380);
    photographs.push_back(
        PhotographPainted(model,
                          camera,
                          kHalfWaves,
                          folder.path(),
                          "s" + std::to_string(i + 1),
                          [&](const Eigen::Array3f& radiance, int x, int) {
                            const bool is_post = x > 110 + 70 * i && x < 135 + 70 * i;
                            return is_post ? Eigen::Array3f(0.01f, 0.02f, 0.5f) : radiance;
                          }));
  }
  const auto share_of_posts = [&](const BakeOptions& options) {
    long num_post = 0;
    const std::vector<PlacedTexel> texels =
        TexelsOf(BakeTextures(model, photographs, options).model, wall);
    for (const PlacedTexel& texel : texels) num_post += texel.radiance[0] < 0.04f ? 1 : 0;
    return static_cast<double>(num_post) / static_cast<double>(texels.size());
  };
  BakeOptions as_they_are;
  as_they_are.reject_occluders = false;
  EXPECT_GT(share_of_posts(as_they_are), 0.02);
  EXPECT_LT(share_of_posts({}), 0.0005);
}

TEST(RejectOccluders, WithTwoPhotographsTheWallsOwnColoursDecide) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 24, 0, 12);
  std::vector<BakePhotograph> photographs;
  for (int i = 0; i < 2; ++i) {
    const Camera camera = LookAt({9.0 + 6 * i, -26, 6}, {12, 0, 6}, 400, 260, 380);
    photographs.push_back(
        PhotographPainted(model,
                          camera,
                          kHalfWaves,
                          folder.path(),
                          "s" + std::to_string(i + 1),
                          [&](const Eigen::Array3f& radiance, int x, int y) {
                            const bool is_van = i == 0 && x > 150 && x < 230 && y > 120;
                            return is_van ? Eigen::Array3f(0.7f, 0.02f, 0.02f) : radiance;
                          }));
  }
  long num_van = 0;
  for (const PlacedTexel& texel : TexelsOf(BakeTextures(model, photographs).model, wall)) {
    num_van += texel.radiance[0] > 0.5f && texel.radiance[1] < 0.06f ? 1 : 0;
  }
  EXPECT_LT(num_van, 30);
}

// A pane of glass shows each camera something else. Whatever is printed must come from one of them.
TEST(RejectOccluders, WindowOnWhichNoTwoPhotographsAgreeIsTakenWholeFromOne) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 24, 0, 12);
  const auto is_window = [](const Eigen::Vector3d& point, double margin) {
    return std::abs(point.x() - 12) < 3 - margin && std::abs(point.z() - 6) < 3 - margin;
  };
  std::vector<BakePhotograph> photographs;
  for (int i = 0; i < 4; ++i) {
    const Paint paint = [&](int, const Eigen::Vector3d& point) -> Eigen::Array3f {
      if (!is_window(point, 0)) return Waves(point);
      const int pane = 7 * static_cast<int>(2 * point.x()) + 3 * static_cast<int>(2 * point.z());
      return Eigen::Array3f::Constant(0.02f) *
             std::pow(2.0f, static_cast<float>((pane * (i + 2) + 3 * i) % 5));
    };
    const Camera camera = LookAt({3.0 + 6 * i, -26, 6}, {12, 0, 6}, 400, 260, 380);
    photographs.push_back(
        PhotographPainted(model, camera, paint, folder.path(), "s" + std::to_string(i + 1)));
  }
  std::map<int, long> num_texels_of;
  long num_texels = 0;
  for (const PlacedTexel& texel : TexelsOf(BakeTextures(model, photographs).model, wall)) {
    if (!is_window(texel.point_in_world, 0.5)) continue;
    ++num_texels_of[texel.source];
    ++num_texels;
  }
  long most = 0;
  for (const auto& [source, count] : num_texels_of) most = std::max(most, count);
  EXPECT_GT(most, 0.97 * static_cast<double>(num_texels));
}

// Of three that show three things, the one in the middle is no majority.
TEST(RejectOccluders, WindowOnWhichNoTwoAgreeIsTakenFromWhoShowsItBest) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 24, 0, 12);
  const auto is_window = [](const Eigen::Vector3d& point, double margin) {
    return std::abs(point.x() - 12) < 2 - margin && std::abs(point.z() - 6) < 2 - margin;
  };
  const float glass[] = {0.15f, 0.10f, 0.24f};
  const Camera cameras[] = {LookAt({-9, -30, 6}, {12, 0, 6}, 400, 260, 330),
                            LookAt({12, -9, 6}, {12, 0, 6}, 640, 416, 288),
                            LookAt({33, -30, 6}, {12, 0, 6}, 400, 260, 330)};
  std::vector<BakePhotograph> photographs;
  for (int i = 0; i < 3; ++i) {
    const Paint paint = [&](int, const Eigen::Vector3d& point) -> Eigen::Array3f {
      return is_window(point, 0) ? Eigen::Array3f::Constant(glass[i]) : Waves(point);
    };
    photographs.push_back(
        PhotographPainted(model, cameras[i], paint, folder.path(), "s" + std::to_string(i + 1)));
  }
  long num_texels = 0;
  long num_near = 0;
  for (const PlacedTexel& texel : TexelsOf(BakeTextures(model, photographs).model, wall)) {
    if (!is_window(texel.point_in_world, 0.5)) continue;
    ++num_texels;
    num_near += texel.source == 2 ? 1 : 0;
  }
  EXPECT_GT(num_texels, 500);
  EXPECT_GT(num_near, 0.95 * num_texels);
}

TEST(ColourHistogram, KnownColoursDoNotSurprise) {
  ColourHistogram histogram;
  EXPECT_EQ(histogram.NegativeLogLikelihood(Eigen::Array3f(-1, -1, -1)), 0);
  for (int i = 0; i < 1000; ++i) histogram.Add(Eigen::Array3f(-1 + 0.0002f * i, -1.5f, -2));
  EXPECT_EQ(histogram.NegativeLogLikelihood(Eigen::Array3f(-0.9f, -1.5f, -2)), 0);
  EXPECT_GT(histogram.NegativeLogLikelihood(Eigen::Array3f(-3, -0.1f, -0.1f)), 5);
}

TEST(SelectPhotographs, RejectedAreLeftOutAndReviewWeighsLess) {
  Scene scene;
  std::vector<Registration> registrations;
  for (const Verdict verdict : {Verdict::kAccepted, Verdict::kReview, Verdict::kRejected}) {
    Registration& registration = registrations.emplace_back();
    registration.name = "s" + std::to_string(registrations.size());
    registration.verdict = verdict;
    registration.width_px = 60;
    registration.height_px = 40;
    Photograph& photograph = scene.photographs.emplace_back();
    photograph.name = registration.name;
    photograph.mask_file = "masks/" + registration.name + ".png";
  }
  const std::vector<BakePhotograph> both = SelectPhotographs(scene, registrations, false);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].weight, 1);
  EXPECT_LT(both[1].weight, 1);
  EXPECT_EQ(both[1].mask_file->string(), "masks/s2.png");
  const std::vector<BakePhotograph> accepted = SelectPhotographs(scene, registrations, true);
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_EQ(accepted[0].name, "s1");
}

}  // namespace
}  // namespace groundglass
