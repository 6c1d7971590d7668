// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Grain and blur: what photographs of one wall differ in where it is finest.
#include "invrender/measure/patches.h"

#include "invrender/bake.h"
#include "invrender/compose/grain.h"
#include "invrender/measure/sharpness.h"
#include "scene/hash.h"
#include "scene/srgb.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace groundglass {
namespace {

constexpr double kWidth = 20;  // of the wall, and its height
constexpr double kHeight = 12;
constexpr double kDistance = 24;  // of the cameras
constexpr double kPxPerUnit = 20;

PolygonModel MakeWall() {
  PolygonModel model;
  AddWall(model, 0, kWidth, 0, kHeight);
  return model;
}

// Before the wall, a little to one side each.
Camera CameraAt(int index, double distance = kDistance) {
  const Eigen::Vector3d target(kWidth / 2, 0, kHeight / 2);
  return LookAt(target + Eigen::Vector3d(1.5 * index - 2.2, -distance, 0.4 * index - 0.6),
                target,
                480,
                320,
                kPxPerUnit * kDistance);
}

// Grey, with a dark line three pixels wide every three units.
Eigen::Array3f Lines(int, const Eigen::Vector3d& point) {
  const double from_line = std::abs(std::remainder(point.x() - 1.5, 3.0));
  return Eigen::Array3f::Constant(from_line < 1.5 / kPxPerUnit ? 0.1f : 0.4f);
}

// Of mean 0 and deviation 1, drawn by place: the sum of four uniform numbers (splitmix64).
double NoiseAt(uint64_t seed, uint64_t x, uint64_t y) {
  uint64_t state = (seed * 8192 + y) * 8192 + x;
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    sum += static_cast<double>(HashOf(state) >> 11) * 0x1.0p-53 - 0.5;
    state += 0x9e3779b97f4a7c15;
  }
  return sum * std::sqrt(3.0);
}

// Each pixel's encoded value off by this standard deviation, the same in all channels.
Develop Grainy(double sigma, uint64_t seed) {
  return [sigma, seed](const Eigen::Array3f& radiance, int x, int y) -> Eigen::Array3f {
    const auto error = static_cast<float>(
        sigma * NoiseAt(seed, static_cast<uint64_t>(x), static_cast<uint64_t>(y)));
    return radiance.unaryExpr([error](float value) {
      return LinearFromSrgb(std::clamp(SrgbFromLinear(value) + error, 0.0f, 1.0f));
    });
  };
}

// Waves of five to forty pixels in all directions, blurred by a lens of this variance, px^2.
Paint BlurredBy(double variance_px2) {
  return [variance_px2](int, const Eigen::Vector3d& point) -> Eigen::Array3f {
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const double angle = i * 0.79;
      const double per_px = 2 * std::numbers::pi / (5 * std::pow(1.35, i));
      const double phase =
          per_px * kPxPerUnit * (std::cos(angle) * point.x() + std::sin(angle) * point.z());
      sum += std::exp(-variance_px2 * per_px * per_px / 2) * std::cos(phase + i);
    }
    return Eigen::Array3f::Constant(static_cast<float>(0.4 + 0.03 * sum));
  };
}

std::vector<Patch> LookAtFaces(const PolygonModel& model,
                               const std::vector<BakePhotograph>& photographs) {
  const Visibility visibility(model);
  std::vector<Chart> charts = MakeCharts(model);
  const std::vector<int> chart_of_face = ChartOfFace(charts, model.faces.size());
  std::vector<std::filesystem::path> files;
  for (const BakePhotograph& photograph : photographs) files.push_back(photograph.image_file);
  PhotoCache cache(files, std::numeric_limits<size_t>::max(), 8);
  const BakeOptions options;
  std::vector<PreparedPhoto> photos;
  for (size_t i = 0; i < photographs.size(); ++i) {
    photos.push_back(
        PreparePhoto(photographs[i],
                     static_cast<int>(i),
                     {model, visibility, nullptr, chart_of_face, options.photos, cache},
                     MaskDetail()));
  }
  return SamplePatches(model, charts, photos, options.patches);
}

std::vector<PlacedTexel> BakeWall(const PolygonModel& model,
                                  const std::vector<BakePhotograph>& photographs,
                                  bool smooth_grain) {
  BakeOptions options;
  if (!smooth_grain) options.stages.smooth_grain = [](auto&&...) {};
  return TexelsOf(BakeTextures(model, photographs, options).model, 0);
}

// Standard deviation of encoded texels that are farther than this from any line.
double GrainBesideLines(const std::vector<PlacedTexel>& texels, double from_line) {
  double sum = 0;
  double squares = 0;
  double count = 0;
  for (const PlacedTexel& texel : texels) {
    const double x = std::abs(std::remainder(texel.point_in_world.x() - 1.5, 3.0));
    if (x < from_line || texel.texels_from_border < 10) continue;
    const double value = SrgbFromLinear(texel.radiance[1]);
    sum += value;
    squares += value * value;
    ++count;
  }
  return std::sqrt(squares / count - sum / count * sum / count);
}

// Mean radiance in the middle of lines.
double LineRadiance(const std::vector<PlacedTexel>& texels) {
  double sum = 0;
  double count = 0;
  for (const PlacedTexel& texel : texels) {
    const double x = std::abs(std::remainder(texel.point_in_world.x() - 1.5, 3.0));
    if (x > 0.5 / kPxPerUnit || texel.texels_from_border < 10) continue;
    sum += texel.radiance[1];
    ++count;
  }
  return sum / count;
}

class Grainy4 : public testing::Test {
 protected:
  void Photograph(const Paint& paint, double sigma) {
    for (int i = 0; i < 4; ++i) {
      photographs_.push_back(PhotographPainted(model_,
                                               CameraAt(i),
                                               paint,
                                               folder_.path(),
                                               "s" + std::to_string(i + 1),
                                               Grainy(sigma, i + 1)));
    }
  }
  const TemporaryFolder folder_;
  const PolygonModel model_ = MakeWall();
  std::vector<BakePhotograph> photographs_;
};

TEST_F(Grainy4, GrainFallsBesideLinesThatStay) {
  Photograph(Lines, 0.012);
  const std::vector<PlacedTexel> kept = BakeWall(model_, photographs_, false);
  const std::vector<PlacedTexel> smooth = BakeWall(model_, photographs_, true);
  EXPECT_GT(GrainBesideLines(kept, 0.5), 0.006);
  EXPECT_LT(GrainBesideLines(smooth, 0.5), 0.5 * GrainBesideLines(kept, 0.5));
  // 0.1 in the truth; pixels and texels blur it.
  EXPECT_NEAR(LineRadiance(smooth), LineRadiance(kept), 0.01);
  EXPECT_LT(LineRadiance(smooth), 0.16);
}

TEST_F(Grainy4, CamerasThatAreOffDoNotBlurLines) {
  Photograph(Lines, 0.012);
  for (int i = 0; i < 4; ++i) {
    // One and a half pixels to either side.
    photographs_[i].camera.center_x_px += i % 2 == 0 ? 1.5 : -1.5;
  }
  const std::vector<PlacedTexel> kept = BakeWall(model_, photographs_, false);
  const std::vector<PlacedTexel> smooth = BakeWall(model_, photographs_, true);
  double change = 0;
  double darkest = 1;
  for (size_t i = 0; i < kept.size(); ++i) {
    if (kept[i].radiance[1] > 0.15f) continue;  // in a line, wherever it is
    change = std::max<double>(change, std::abs(kept[i].radiance[1] - smooth[i].radiance[1]));
    darkest = std::min<double>(darkest, smooth[i].radiance[1]);
  }
  EXPECT_LT(darkest, 0.13);
  EXPECT_LT(change, 0.02);
}

TEST_F(Grainy4, DetailThatPhotographsShareStaysHoweverFaint) {
  // Specks of three pixels, as strong as the grain.
  const Paint specks = [](int, const Eigen::Vector3d& point) -> Eigen::Array3f {
    const auto x = static_cast<uint64_t>(std::floor(point.x() * kPxPerUnit / 3) + 1000);
    const auto z = static_cast<uint64_t>(std::floor(point.z() * kPxPerUnit / 3) + 1000);
    const double error = 0.015 * NoiseAt(9, x, z);
    return Eigen::Array3f::Constant(LinearFromSrgb(static_cast<float>(0.66 + error)));
  };
  Photograph(specks, 0.012);
  const std::vector<PlacedTexel> kept = BakeWall(model_, photographs_, false);
  const std::vector<PlacedTexel> smooth = BakeWall(model_, photographs_, true);
  double squares = 0;
  for (size_t i = 0; i < kept.size(); ++i) {
    squares += (kept[i].radiance - smooth[i].radiance).square().mean();
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(kept.size())), 0.001);
}

TEST_F(Grainy4, MeasuresTheGrainOfEachPhotograph) {
  const std::array<double, 4> sigmas = {0.006, 0.009, 0.012, 0.016};
  for (int i = 0; i < 4; ++i) {
    photographs_.push_back(PhotographPainted(model_,
                                             CameraAt(i),
                                             Lines,
                                             folder_.path(),
                                             "s" + std::to_string(i + 1),
                                             Grainy(sigmas[i], i + 1)));
  }
  const Grain grain = MeasureGrain(LookAtFaces(model_, photographs_), 1, 4, GrainOptions());
  EXPECT_GT(grain.certainty[0], 0.9);
  for (int i = 0; i < 4; ++i) {
    // White noise keeps 0.794 of its variance in the finest band; looking up between pixels takes
    // some of that.
    const double share = grain.variances[i][0] / (0.794 * sigmas[i] * sigmas[i]);
    EXPECT_GT(share, 0.35) << i;
    EXPECT_LT(share, 1.2) << i;
    if (i > 0) {
      EXPECT_GT(grain.variances[i][0], 1.3 * grain.variances[i - 1][0]);
    }
  }
}

class Blurred : public testing::Test {
 protected:
  Blurred() {
    const std::array<double, 4> variances_px2 = {0.36, 0.36, 2.36, 0.36};
    for (int i = 0; i < 4; ++i) {
      // The blurred one is a little nearer, and would be preferred.
      photographs_.push_back(PhotographPainted(model_,
                                               CameraAt(i, i == 2 ? kDistance - 2 : kDistance),
                                               BlurredBy(variances_px2[i]),
                                               folder_.path(),
                                               "s" + std::to_string(i + 1),
                                               Grainy(0.008, i + 1)));
    }
  }
  const TemporaryFolder folder_;
  const PolygonModel model_ = MakeWall();
  std::vector<BakePhotograph> photographs_;
};

TEST_F(Blurred, IsMeasuredByComparison) {
  const std::vector<Sharpness> sharpness =
      MeasureSharpness(LookAtFaces(model_, photographs_), 4, SharpnessOptions());
  for (const int sharp : {0, 1, 3}) {
    EXPECT_EQ(sharpness[sharp].factor, 1);
    // 2.4 in truth. The heat equation holds for small differences, and falls short of large ones.
    const double more = (sharpness[2].blur_px2 - sharpness[sharp].blur_px2).mean();
    EXPECT_GT(more, 1.1);
    EXPECT_LT(more, 2.6);
  }
  EXPECT_LT(sharpness[2].factor, 0.65);
}

TEST_F(Blurred, IsHardlyPrintedWhereSharpOnesShowThePlace) {
  const auto share = [&](bool judge_sharpness) {
    BakeOptions options;
    if (!judge_sharpness) {
      options.stages.measure_sharpness = [](auto&&...) { return std::vector<Sharpness>(); };
    }
    const BakeResult bake = BakeTextures(model_, photographs_, options);
    const std::vector<PlacedTexel> texels = TexelsOf(bake.model, 0);
    const auto blurred = std::count_if(
        texels.begin(), texels.end(), [](const PlacedTexel& texel) { return texel.source == 3; });
    return static_cast<double>(blurred) / static_cast<double>(texels.size());
  };
  EXPECT_GT(share(false), 0.15);
  EXPECT_LT(share(true), 0.02);
}

TEST_F(Blurred, IsTheSameForAnyNumberOfThreads) {
  const BakeResult many = BakeTextures(model_, photographs_);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const BakeResult alone = BakeTextures(model_, photographs_);
  EXPECT_EQ(many.model.pages.at(0).srgb8.values, alone.model.pages.at(0).srgb8.values);
}

}  // namespace
}  // namespace groundglass
