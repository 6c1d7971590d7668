// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/measure/sharpness.h"

#include "invrender/measure/bounded_least_squares.h"
#include "invrender/measure/median.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// What is left of a patch when it is smoothed, and when it is differentiated.
constexpr int kSmoothSide = kPatchSide - 8;
constexpr int kInnerSide = kSmoothSide - 2;
constexpr int kNumInner = kInnerSide * kInnerSide;

using SmoothPatch = Eigen::Array<double, kSmoothSide, kSmoothSide>;
using InnerPatch = Eigen::Array<double, kInnerSide, kInnerSide>;

// Smoothed by a binomial of variance 2, so that grain hardly counts; mean 1.
SmoothPatch Smooth(const PatchSamples& luma) {
  constexpr std::array<double, 9> kBinomial = {1, 8, 28, 56, 70, 56, 28, 8, 1};
  Eigen::Array<double, kPatchSide, kSmoothSide> rows;
  SmoothPatch smooth = SmoothPatch::Zero();
  rows.setZero();
  for (int i = 0; i < 9; ++i) rows += kBinomial[i] * luma.middleCols<kSmoothSide>(i).cast<double>();
  for (int i = 0; i < 9; ++i) smooth += kBinomial[i] * rows.middleRows<kSmoothSide>(i);
  return smooth / std::max(1e-3, smooth.mean());
}

// What one pair of photographs says of their blurs at a patch, as rows of normal equations: the
// first's along x and y, then the second's. Zero where they do not look alike.
struct PairEvidence {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
};

PairEvidence ComparePair(const PatchView& first,
                         const SmoothPatch& first_smooth,
                         const PatchView& second,
                         const SmoothPatch& second_smooth,
                         const SharpnessOptions& options) {
  PairEvidence evidence;
  const auto inner = [](const SmoothPatch& patch, int dx, int dy) {
    return patch.block<kInnerSide, kInnerSide>(1 + dy, 1 + dx);
  };
  const InnerPatch a = inner(first_smooth, 0, 0) - inner(first_smooth, 0, 0).mean();
  const InnerPatch b = inner(second_smooth, 0, 0) - inner(second_smooth, 0, 0).mean();
  const double scale = std::sqrt(a.square().sum() * b.square().sum());
  if (!((a * b).sum() > options.alike * scale)) return evidence;

  const SmoothPatch mean = (first_smooth + second_smooth) / 2;
  const InnerPatch here = inner(mean, 0, 0);
  const InnerPatch dx = (inner(mean, 1, 0) - inner(mean, -1, 0)) / 2;
  const InnerPatch dy = (inner(mean, 0, 1) - inner(mean, 0, -1)) / 2;
  const InnerPatch dxx = inner(mean, 1, 0) + inner(mean, -1, 0) - 2 * here;
  const InnerPatch dyy = inner(mean, 0, 1) + inner(mean, 0, -1) - 2 * here;
  const InnerPatch dxy =
      (inner(mean, 1, 1) + inner(mean, -1, -1) - inner(mean, 1, -1) - inner(mean, -1, 1)) / 4;
  // What a blur of 1 px^2 along one of the photograph's axes changes.
  const auto effect = [&](const PatchView& view, int axis) -> InnerPatch {
    const Eigen::Vector2d along = view.step_from_px.col(axis);
    return (along.x() * along.x() * dxx + along.y() * along.y() * dyy +
            2 * along.x() * along.y() * dxy) /
           2;
  };
  Eigen::Matrix<double, kNumInner, 5> rows;  // four effects, and the difference
  rows.col(0) = -effect(first, 0).reshaped();
  rows.col(1) = -effect(first, 1).reshaped();
  rows.col(2) = effect(second, 0).reshaped();
  rows.col(3) = effect(second, 1).reshaped();
  rows.col(4) = (b - a).reshaped();
  // What does not tell of blur: brightness, contrast, and a shift.
  Eigen::Matrix<double, kNumInner, 4> other;
  other.col(0).setOnes();
  other.col(1) = here.reshaped();
  other.col(2) = dx.reshaped();
  other.col(3) = dy.reshaped();
  Eigen::Matrix4d other_normal = other.transpose() * other;
  other_normal.diagonal().array() += 1e-9;
  const Eigen::Matrix<double, 4, 5> fitted = other_normal.ldlt().solve(other.transpose() * rows);
  rows -= other * fitted;
  // Each patch counts once, however strong its contrast.
  const double strength = rows.leftCols<4>().squaredNorm() / kNumInner;
  const double weight = 1 / (strength + options.detail_floor * options.detail_floor) / kNumInner;
  evidence.normal = weight * rows.leftCols<4>().transpose() * rows.leftCols<4>();
  evidence.right = weight * rows.leftCols<4>().transpose() * rows.col(4);
  return evidence;
}

// In the order of the pairs (0, 1), (0, 2), ..., (1, 2), ...
std::vector<PairEvidence> ComparePairs(const Patch& patch, const SharpnessOptions& options) {
  std::vector<SmoothPatch> smooth;
  for (const PatchView& view : patch.views) smooth.push_back(Smooth(view.luma));
  std::vector<PairEvidence> evidence;
  for (size_t a = 0; a < smooth.size(); ++a) {
    for (size_t b = a + 1; b < smooth.size(); ++b) {
      evidence.push_back(
          ComparePair(patch.views[a], smooth[a], patch.views[b], smooth[b], options));
    }
  }
  return evidence;
}

}  // namespace

std::vector<Sharpness> MeasureSharpness(const std::vector<Patch>& patches,
                                        size_t num_photos,
                                        const SharpnessOptions& options) {
  std::vector<Sharpness> sharpness(num_photos);
  if (num_photos == 0) return sharpness;
  std::vector<std::vector<PairEvidence>> evidence(patches.size());
  tbb::parallel_for(size_t{0}, patches.size(), [&](size_t i) {
    evidence[i] = ComparePairs(patches[i], options);
  });

  const auto num_unknowns = static_cast<Eigen::Index>(2 * num_photos);
  Eigen::MatrixXd normal =
      options.ordinary_weight * Eigen::MatrixXd::Identity(num_unknowns, num_unknowns);
  Eigen::VectorXd right =
      Eigen::VectorXd::Constant(num_unknowns, options.ordinary_weight * options.ordinary_blur_px2);
  for (size_t i = 0; i < patches.size(); ++i) {
    const std::vector<PatchView>& views = patches[i].views;
    size_t pair = 0;
    for (size_t a = 0; a < views.size(); ++a) {
      for (size_t b = a + 1; b < views.size(); ++b, ++pair) {
        const std::array<int, 4> index = {
            2 * views[a].photo, 2 * views[a].photo + 1, 2 * views[b].photo, 2 * views[b].photo + 1};
        for (int r = 0; r < 4; ++r) {
          right[index[r]] += evidence[i][pair].right[r];
          for (int c = 0; c < 4; ++c) normal(index[r], index[c]) += evidence[i][pair].normal(r, c);
        }
      }
    }
  }
  const Eigen::VectorXd blur = SolveBounded(normal, right, options.least_blur_px2);

  std::vector<double> means;
  for (size_t i = 0; i < num_photos; ++i) {
    sharpness[i].blur_px2 = blur.segment<2>(static_cast<Eigen::Index>(2 * i));
    means.push_back(sharpness[i].blur_px2.mean());
  }
  const double ordinary = std::max(options.ordinary_blur_px2, Median(means));
  for (Sharpness& s : sharpness) {
    const double worse = s.blur_px2.maxCoeff() / ordinary;
    const double better = std::max(1.0, s.blur_px2.minCoeff() / ordinary);
    const double certainty =
        std::clamp((worse - options.doubtful) / (options.certain - options.doubtful), 0.0, 1.0);
    // As in PreparedPhoto::Quality: the worse direction counts three times.
    s.factor = std::pow(1 + certainty * (worse - 1), -3.0 / 8) *
               std::pow(1 + certainty * (better - 1), -1.0 / 8);
  }
  return sharpness;
}

}  // namespace groundglass
