// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/shared_edge_cost.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace groundglass {
namespace {

constexpr int kNumSamples = 8;

// One edge in one photograph, its samples anywhere about where the camera sees it.
class SharedEdgeFixture {
 public:
  SharedEdgeFixture() {
    ViewTag tag;
    tag.position_in_site = {30, 60, 5};
    tag.lookat_in_site = {20, 0, 10};
    tag.view_angle_deg = 54;
    tag.k1 = -0.05;
    prior_ = SplitIntoOwnAndLens(MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {}),
                                 LensParameters{{0.6, 0.3, 0.5, 0.4, 0.2}});
    frame_.across << 0.1, 0, 0.02, 0.09, 0, 0.05;
    frame_.turn_ratio = 0.7;
    groups_.resize(2);
    groups_[0].directions = Eigen::Vector3d(0.1, -0.2, 0.05);
    groups_[1].directions.resize(3, 2);
    groups_[1].directions << 0.2, 0.01, -0.03, 0.1, 0.04, 0.15;
    const ParameterProjection projection =
        prior_.ProjectionAt(CameraParameters::Zero(), LensParameters::Zero());
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < kNumSamples; ++i) {
      AlignedSample sample;
      sample.along = -1 + 2.0 * i / (kNumSamples - 1);
      sample.point_in_world = {20 + 15 * sample.along, 2, 10};
      sample.origin_px = projection.Project(sample.point_in_world)->image_px;
      sample.normal = Eigen::Vector2d(0.3 * unit(random), 1).normalized();
      sample.offset_px = unit(random);
      sample.precision = 0.5 + 0.4 * unit(random);
      sample.bias_px = {0.5, 0.4 * sample.along};
      samples_.push_back(sample);
    }
  }

  // All blocks one after the other.
  static constexpr int kNumBlocks = 5;
  static constexpr std::array<int, kNumBlocks> kSizes = {
      kNumCameraParameters, kNumLensParameters, 4, 1, 2};
  static constexpr int kNumValues = kNumCameraParameters + kNumLensParameters + 4 + 1 + 2;
  using Values = Eigen::Matrix<double, kNumValues, 1>;
  using Jacobian = Eigen::Matrix<double, kNumSamples, kNumValues>;

  Eigen::Matrix<double, kNumSamples, 1> Evaluate(const Values& values, Jacobian* jacobian) const {
    const SharedEdgeCost cost(samples_, prior_, frame_, groups_);
    std::array<const double*, kNumBlocks> blocks{};
    std::array<std::vector<double>, kNumBlocks> by_block;
    std::array<double*, kNumBlocks> jacobians{};
    const double* next = values.data();
    for (int block = 0; block < kNumBlocks; ++block) {
      blocks[block] = next;
      next += kSizes[block];
      by_block[block].resize(kNumSamples * kSizes[block]);
      jacobians[block] = by_block[block].data();
    }
    Eigen::Matrix<double, kNumSamples, 1> residuals;
    EXPECT_TRUE(
        cost.Evaluate(blocks.data(), residuals.data(), jacobian ? jacobians.data() : nullptr));
    if (jacobian) {
      int column = 0;
      for (int block = 0; block < kNumBlocks; ++block) {
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        jacobian->middleCols(column, kSizes[block]) =
            Eigen::Map<const Rows>(jacobians[block], kNumSamples, kSizes[block]);
        column += kSizes[block];
      }
    }
    return residuals;
  }

 private:
  SplitPrior prior_;
  EdgeFrame frame_;
  std::vector<EdgeGroupPart> groups_;
  std::vector<AlignedSample> samples_;
};

TEST(SharedEdgeCost, JacobiansOfAllBlocksMatchFiniteDifferences) {
  const SharedEdgeFixture fixture;
  SharedEdgeFixture::Values at = SharedEdgeFixture::Values::LinSpaced(-0.4, 0.5);
  SharedEdgeFixture::Jacobian jacobian;
  fixture.Evaluate(at, &jacobian);
  for (int i = 0; i < SharedEdgeFixture::kNumValues; ++i) {
    constexpr double kStep = 1e-5;
    SharedEdgeFixture::Values ahead = at, behind = at;
    ahead[i] += kStep;
    behind[i] -= kStep;
    const Eigen::VectorXd difference =
        (fixture.Evaluate(ahead, nullptr) - fixture.Evaluate(behind, nullptr)) / (2 * kStep);
    EXPECT_LT((difference - jacobian.col(i)).norm(), 1e-5 * (1 + difference.norm())) << i;
  }
}

}  // namespace
}  // namespace groundglass
