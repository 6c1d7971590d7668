// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/image_edge_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

// Samples along an edge whose error of its own is 1 px, of its shift alone.
std::vector<AlignedSample> Samples(int count, double precision) {
  std::vector<AlignedSample> samples(count);
  for (AlignedSample& sample : samples) {
    sample.precision = precision;
    sample.bias_px = {1, 0};
  }
  return samples;
}

TEST(ImageEdgeError, SamplesThatSayNothingLeaveItAsItIs) {
  const std::vector<double> residuals_px(5, 3.0);
  const ImageEdgeError own = EstimateImageEdgeError(Samples(5, 0), residuals_px, 3);
  EXPECT_NEAR(own.widening, 1, 1e-9);
  EXPECT_NEAR(own.size, 1, 1e-9);
}

TEST(ImageEdgeError, AnEdgeFarOffIsTakenAsFarAsItLies) {
  // Known exactly to lie 6 px off: one dimension says 36, the other, of which nothing is known, is
  // as wide as the first makes it: v = (3 + 36 + v) / 5.
  const std::vector<double> residuals_px(10, 6.0);
  const ImageEdgeError own = EstimateImageEdgeError(Samples(10, 1e9), residuals_px, 3);
  EXPECT_NEAR(own.widening, std::sqrt(39 / 4.0), 1e-3);
  EXPECT_NEAR(own.size, (36 + 39 / 4.0) / (39 / 4.0) / 2, 1e-3);
}

TEST(ImageEdgeError, ItsMeanSizeFindsTheScaleOfAStudentT) {
  // Errors of t with 3 degrees of freedom and scale 2.5, in both dimensions; estimated from 1.
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> chi_squared(3);
  constexpr int kEdges = 4000;
  std::vector<Eigen::Vector2d> errors;
  for (int i = 0; i < kEdges; ++i) {
    const Eigen::Vector2d unit(normal(random), normal(random));
    errors.push_back(2.5 * unit / std::sqrt(chi_squared(random) / 3));
  }
  double scale = 1;
  for (int round = 0; round < 30; ++round) {
    double sum = 0;
    for (const Eigen::Vector2d& error : errors) {
      std::vector<AlignedSample> samples(2);
      std::vector<double> residuals_px(2);
      for (int k = 0; k < 2; ++k) {
        samples[k].precision = 1e6;
        samples[k].bias_px[k] = scale;
        residuals_px[k] = error[k];
      }
      sum += EstimateImageEdgeError(samples, residuals_px, 3).size;
    }
    scale *= std::sqrt(sum / kEdges);
  }
  EXPECT_NEAR(scale, 2.5, 0.08);
}

}  // namespace
}  // namespace groundglass
