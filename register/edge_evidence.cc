// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edge_evidence.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr int kNumLevels = 4;

// Gradients by Gaussian derivatives of sigma 1, divided by the level's own noise.
ImageF NoiseScaledGradient(const cv::Mat& grey) {
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, {0, 0}, 1.0, 1.0, cv::BORDER_REPLICATE);
  ImageF gradient(grey.cols, grey.rows, 2);
  std::vector<float> magnitudes;
  magnitudes.reserve(static_cast<size_t>(grey.cols) * grey.rows / 4);
  for (int y = 0; y < grey.rows; ++y) {
    const float* above = smooth.ptr<float>(std::max(0, y - 1));
    const float* here = smooth.ptr<float>(y);
    const float* below = smooth.ptr<float>(std::min(grey.rows - 1, y + 1));
    for (int x = 0; x < grey.cols; ++x) {
      float* g = gradient.At(x, y);
      g[0] = (here[std::min(grey.cols - 1, x + 1)] - here[std::max(0, x - 1)]) / 2;
      g[1] = (below[x] - above[x]) / 2;
      if (((x | y) & 1) == 0) magnitudes.push_back(std::hypot(g[0], g[1]));
    }
  }
  // The median magnitude: most of a photograph is surface, not edge. Flat skies would make it too
  // small, so it never counts as less than a tenth of a grey level.
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  const float noise = std::max(0.4f, *middle);
  for (float& value : gradient.values) value /= noise;
  return gradient;
}

}  // namespace

EdgeEvidence::EdgeEvidence(const Image8& grey8, const Image8& ignore) : ignore_(ignore) {
  cv::Mat grey;
  cv::Mat(grey8.height, grey8.width, CV_8UC1, const_cast<uint8_t*>(grey8.values.data()))
      .convertTo(grey, CV_32F);
  double scale = 1;
  for (int level = 0; level < kNumLevels; ++level) {
    levels_.push_back({scale, NoiseScaledGradient(grey)});
    if (grey.cols < 64 || grey.rows < 64) break;
    cv::Mat half;
    cv::resize(grey, half, {(grey.cols + 1) / 2, (grey.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
    grey = half;
    scale *= 2;
  }
}

const EdgeEvidence::Level& EdgeEvidence::AtScale(double px_per_cell) const {
  size_t best = 0;
  while (best + 1 < levels_.size() && levels_[best + 1].scale <= px_per_cell) ++best;
  return levels_[best];
}

std::vector<EdgeCandidate> EdgeEvidence::FindCandidates(const Eigen::Vector2d& image_px,
                                                        const Eigen::Vector2d& normal,
                                                        double range_px,
                                                        int max_candidates,
                                                        double gate_deg) const {
  // Weaker than this many times the noise is texture.
  constexpr float kMinStrength = 1.5f;
  const Level& level = AtScale(range_px / 12);
  const ImageF& gradient = level.gradient;
  const double cos_gate = std::cos(gate_deg / 57.29577951308232);
  const int reach = static_cast<int>(std::ceil(range_px / level.scale)) + 1;

  thread_local std::vector<float> along;
  thread_local std::vector<float> magnitude;
  along.assign(2 * reach + 1, 0.f);
  magnitude.assign(2 * reach + 1, 0.f);
  for (int k = -reach; k <= reach; ++k) {
    const Eigen::Vector2d at = image_px / level.scale + k * normal;
    // Pixel centres lie at half numbers.
    const double x = at.x() - 0.5;
    const double y = at.y() - 0.5;
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    if (x0 < 2 || y0 < 2 || x0 + 3 >= gradient.width || y0 + 3 >= gradient.height) continue;
    if (!ignore_.Empty()) {
      const int px = std::min(ignore_.width - 1, static_cast<int>(at.x() * level.scale));
      const int py = std::min(ignore_.height - 1, static_cast<int>(at.y() * level.scale));
      if (*ignore_.At(px, py) != 0) continue;
    }
    const auto fx = static_cast<float>(x - x0);
    const auto fy = static_cast<float>(y - y0);
    const float* g00 = gradient.At(x0, y0);
    const float* g01 = gradient.At(x0, y0 + 1);
    const float gx =
        (1 - fy) * ((1 - fx) * g00[0] + fx * g00[2]) + fy * ((1 - fx) * g01[0] + fx * g01[2]);
    const float gy =
        (1 - fy) * ((1 - fx) * g00[1] + fx * g00[3]) + fy * ((1 - fx) * g01[1] + fx * g01[3]);
    along[k + reach] = gx * static_cast<float>(normal.x()) + gy * static_cast<float>(normal.y());
    magnitude[k + reach] = std::hypot(gx, gy);
  }

  std::vector<EdgeCandidate> candidates;
  for (int k = 1; k < 2 * reach; ++k) {
    const float here = std::abs(along[k]);
    if (here < kMinStrength || here < cos_gate * magnitude[k]) continue;
    const float sign = along[k] > 0 ? 1.f : -1.f;
    const float before = sign * along[k - 1];
    const float after = sign * along[k + 1];
    if (before > here || after >= here) continue;
    // The vertex of the parabola through the logarithms of three samples: a step edge seen through
    // a Gaussian has a Gaussian profile, whose logarithm is a parabola.
    float shift = 0;
    if (before > 0 && after > 0) {
      const float log_before = std::log(before);
      const float log_after = std::log(after);
      const float curvature = log_before - 2 * std::log(here) + log_after;
      if (curvature < 0) shift = 0.5f * (log_before - log_after) / curvature;
    } else {
      shift = 0.5f * (before - after) / (before - 2 * here + after);
    }
    const double offset_px = (k - reach + shift) * level.scale;
    if (std::abs(offset_px) > range_px) continue;
    candidates.push_back({offset_px, along[k]});
  }
  if (static_cast<int>(candidates.size()) > max_candidates) {
    std::nth_element(candidates.begin(),
                     candidates.begin() + max_candidates,
                     candidates.end(),
                     [](const EdgeCandidate& a, const EdgeCandidate& b) {
                       return std::abs(a.strength) > std::abs(b.strength);
                     });
    candidates.resize(max_candidates);
  }
  return candidates;
}

}  // namespace groundglass
