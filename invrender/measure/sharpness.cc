// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/measure/sharpness.h"

#include "invrender/measure/bounded_least_squares.h"
#include "scene/quantile.h"

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

// A smoothed patch without its rim, moved by a sample.
Eigen::Block<const SmoothPatch, kInnerSide, kInnerSide> Inner(const SmoothPatch& patch,
                                                              int dx,
                                                              int dy) {
  return patch.block<kInnerSide, kInnerSide>(1 + dy, 1 + dx);
}

bool LookAlike(const SmoothPatch& first, const SmoothPatch& second, double alike) {
  const InnerPatch a = Inner(first, 0, 0) - Inner(first, 0, 0).mean();
  const InnerPatch b = Inner(second, 0, 0) - Inner(second, 0, 0).mean();
  return (a * b).sum() > alike * std::sqrt(a.square().sum() * b.square().sum());
}

// Four columns: what a blur of 1 px^2 along x and y of the first photograph changes in the
// difference of the two, then of the second. The fifth is the difference.
using BlurColumns = Eigen::Matrix<double, kNumInner, 5>;

BlurColumns MakeBlurColumns(const PatchView& first,
                            const SmoothPatch& first_smooth,
                            const PatchView& second,
                            const SmoothPatch& second_smooth) {
  const SmoothPatch mean = (first_smooth + second_smooth) / 2;
  const InnerPatch here = Inner(mean, 0, 0);
  const InnerPatch dxx = Inner(mean, 1, 0) + Inner(mean, -1, 0) - 2 * here;
  const InnerPatch dyy = Inner(mean, 0, 1) + Inner(mean, 0, -1) - 2 * here;
  const InnerPatch dxy =
      (Inner(mean, 1, 1) + Inner(mean, -1, -1) - Inner(mean, 1, -1) - Inner(mean, -1, 1)) / 4;
  const auto effect = [&](const PatchView& view, int axis) -> InnerPatch {
    const Eigen::Vector2d along = view.step_from_px.col(axis);
    return (along.x() * along.x() * dxx + along.y() * along.y() * dyy +
            2 * along.x() * along.y() * dxy) /
           2;
  };
  BlurColumns columns;
  columns.col(0) = -effect(first, 0).reshaped();
  columns.col(1) = -effect(first, 1).reshaped();
  columns.col(2) = effect(second, 0).reshaped();
  columns.col(3) = effect(second, 1).reshaped();
  columns.col(4) = ((Inner(second_smooth, 0, 0) - Inner(second_smooth, 0, 0).mean()) -
                    (Inner(first_smooth, 0, 0) - Inner(first_smooth, 0, 0).mean()))
                       .reshaped();
  return columns;
}

// Takes off what does not tell of blur: brightness, contrast, and a shift.
void RemoveNuisances(const SmoothPatch& mean, BlurColumns& columns) {
  Eigen::Matrix<double, kNumInner, 4> other;
  other.col(0).setOnes();
  other.col(1) = Inner(mean, 0, 0).reshaped();
  other.col(2) = ((Inner(mean, 1, 0) - Inner(mean, -1, 0)) / 2).reshaped();
  other.col(3) = ((Inner(mean, 0, 1) - Inner(mean, 0, -1)) / 2).reshaped();
  Eigen::Matrix4d normal = other.transpose() * other;
  normal.diagonal().array() += 1e-9;
  const Eigen::Matrix<double, 4, 5> fitted = normal.ldlt().solve(other.transpose() * columns);
  columns -= other * fitted;
}

PairEvidence ComparePair(const PatchView& first,
                         const SmoothPatch& first_smooth,
                         const PatchView& second,
                         const SmoothPatch& second_smooth,
                         const SharpnessOptions& options) {
  PairEvidence evidence;
  if (!LookAlike(first_smooth, second_smooth, options.alike)) return evidence;
  BlurColumns columns = MakeBlurColumns(first, first_smooth, second, second_smooth);
  RemoveNuisances((first_smooth + second_smooth) / 2, columns);
  // Each patch counts once, however strong its contrast.
  const double strength = columns.leftCols<4>().squaredNorm() / kNumInner;
  const double weight = 1 / (strength + options.detail_floor * options.detail_floor) / kNumInner;
  evidence.normal = weight * columns.leftCols<4>().transpose() * columns.leftCols<4>();
  evidence.right = weight * columns.leftCols<4>().transpose() * columns.col(4);
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

// The variances of all photographs' blurs along x and y, px^2, from what every pair says.
Eigen::VectorXd SolveBlurs(const std::vector<Patch>& patches,
                           const std::vector<std::vector<PairEvidence>>& evidence,
                           size_t num_photos,
                           const SharpnessOptions& options) {
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
  return SolveBounded(normal, right, options.least_blur_px2);
}

// What a photograph's resolution is worth, of which the ordinary blur is this, px^2.
double SharpnessFactor(const Eigen::Vector2d& blur_px2,
                       double ordinary_px2,
                       const SharpnessOptions& options) {
  const double worse = blur_px2.maxCoeff() / ordinary_px2;
  const double better = std::max(1.0, blur_px2.minCoeff() / ordinary_px2);
  const double certainty =
      std::clamp((worse - options.doubtful) / (options.certain - options.doubtful), 0.0, 1.0);
  // As in PreparedPhoto::Quality: the worse direction counts three times.
  return std::pow(1 + certainty * (worse - 1), -3.0 / 8) *
         std::pow(1 + certainty * (better - 1), -1.0 / 8);
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
  const Eigen::VectorXd blur = SolveBlurs(patches, evidence, num_photos, options);
  std::vector<double> means;
  for (size_t i = 0; i < num_photos; ++i) {
    sharpness[i].blur_px2 = blur.segment<2>(static_cast<Eigen::Index>(2 * i));
    means.push_back(sharpness[i].blur_px2.mean());
  }
  const double ordinary_px2 = std::max(options.ordinary_blur_px2, UpperMedian(std::move(means)));
  for (Sharpness& s : sharpness) s.factor = SharpnessFactor(s.blur_px2, ordinary_px2, options);
  return sharpness;
}

}  // namespace groundglass
