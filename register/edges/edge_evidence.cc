// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_evidence.h"

#include "scene/frames.h"
#include "scene/quantile.h"
#include "scene/srgb.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

constexpr int kNumLevels = 4;

// Gradients by Gaussian derivatives of sigma 1; 2 channels: x, y.
ImageF GradientOf(const cv::Mat& values) {
  cv::Mat smooth;
  cv::GaussianBlur(values, smooth, {0, 0}, 1.0, 1.0, cv::BORDER_REPLICATE);
  ImageF gradient(values.cols, values.rows, 2);
  for (int y = 0; y < values.rows; ++y) {
    const float* above = smooth.ptr<float>(std::max(0, y - 1));
    const float* here = smooth.ptr<float>(y);
    const float* below = smooth.ptr<float>(std::min(values.rows - 1, y + 1));
    for (int x = 0; x < values.cols; ++x) {
      float* g = gradient.At(x, y);
      g[0] = (here[std::min(values.cols - 1, x + 1)] - here[std::max(0, x - 1)]) / 2;
      g[1] = (below[x] - above[x]) / 2;
    }
  }
  return gradient;
}

// Divides a gradient of grey levels by its own noise.
void ScaleByNoise(ImageF& gradient) {
  std::vector<float> magnitudes;
  magnitudes.reserve(gradient.values.size() / 8 + gradient.width);
  for (int y = 0; y < gradient.height; y += 2) {
    for (int x = 0; x < gradient.width; x += 2) {
      const float* g = gradient.At(x, y);
      magnitudes.push_back(std::hypot(g[0], g[1]));
    }
  }
  // The median magnitude: most of a photograph is surface, not edge. Flat skies and clipped whites
  // would make it too small, so it never counts as less than 0.4 grey levels for each pixel.
  constexpr float kLeastNoise = 0.4f;
  const float noise = std::max(kLeastNoise, UpperMedian(std::move(magnitudes)));
  for (float& value : gradient.values) value /= noise;
}

cv::Mat LightOf(const cv::Mat& grey8) {
  cv::Mat light;
  cv::LUT(grey8, cv::Mat(1, 256, CV_32F, const_cast<float*>(LinearOfSrgb8().data())), light);
  return light;
}

cv::Mat Halved(const cv::Mat& image) {
  cv::Mat half;
  cv::resize(image, half, {(image.cols + 1) / 2, (image.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
  return half;
}

// A gradient between pixels; nothing within two pixels of the border.
std::optional<Eigen::Vector2f> GradientAt(const ImageF& gradient, const Eigen::Vector2d& at_px) {
  // Pixel centres lie at half numbers.
  const double x = at_px.x() - 0.5;
  const double y = at_px.y() - 0.5;
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  if (x0 < 2 || y0 < 2 || x0 + 3 >= gradient.width || y0 + 3 >= gradient.height) return {};
  const auto fx = static_cast<float>(x - x0);
  const auto fy = static_cast<float>(y - y0);
  using Pair = Eigen::Map<const Eigen::Vector2f>;
  const float* top = gradient.At(x0, y0);
  const float* bottom = gradient.At(x0, y0 + 1);
  return (1 - fy) * ((1 - fx) * Pair(top) + fx * Pair(top + 2)) +
         fy * ((1 - fx) * Pair(bottom) + fx * Pair(bottom + 2));
}

// Where between three equidistant samples of a profile its peak lies, from the middle one: the
// vertex of the parabola through their logarithms. A step edge seen through a Gaussian has a
// Gaussian profile, whose logarithm is a parabola. here must be the greatest.
float PeakShift(float before, float here, float after) {
  if (before > 0 && after > 0) {
    const float log_before = std::log(before);
    const float log_after = std::log(after);
    const float curvature = log_before - 2 * std::log(here) + log_after;
    return curvature < 0 ? 0.5f * (log_before - log_after) / curvature : 0;
  }
  return 0.5f * (before - after) / (before - 2 * here + after);
}

}  // namespace

EdgeEvidence::EdgeEvidence(const Image8& grey8, const Image8& ignore) : ignore_(ignore) {
  const cv::Mat codes(
      grey8.height, grey8.width, CV_8UC1, const_cast<uint8_t*>(grey8.values.data()));
  cv::Mat grey;
  codes.convertTo(grey, CV_32F);
  cv::Mat light = LightOf(codes);
  double scale = 1;
  for (int level = 0; level < kNumLevels; ++level) {
    levels_.push_back({scale, GradientOf(grey), GradientOf(light)});
    ScaleByNoise(levels_.back().gradient);
    if (grey.cols < 64 || grey.rows < 64) break;
    grey = Halved(grey);
    light = Halved(light);
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
  const double cos_gate = std::cos(RadiansFromDegrees(gate_deg));
  const int reach = static_cast<int>(std::ceil(range_px / level.scale)) + 1;

  const Eigen::Vector2d origin = image_px / level.scale;
  const Eigen::Vector2f direction = normal.cast<float>();
  thread_local std::vector<float> along;
  thread_local std::vector<float> magnitude;
  along.assign(2 * reach + 1, 0.f);
  magnitude.assign(2 * reach + 1, 0.f);
  for (int k = -reach; k <= reach; ++k) {
    const Eigen::Vector2d at = origin + k * normal;
    const auto g = GradientAt(gradient, at);
    if (!g) continue;
    if (!ignore_.Empty()) {
      const int px = std::min(ignore_.width - 1, static_cast<int>(at.x() * level.scale));
      const int py = std::min(ignore_.height - 1, static_cast<int>(at.y() * level.scale));
      if (*ignore_.At(px, py) != 0) continue;
    }
    along[k + reach] = g->dot(direction);
    magnitude[k + reach] = g->norm();
  }
  const auto light_along = [&](int k) {
    const auto g = GradientAt(level.light_gradient, origin + k * normal);
    return g ? g->dot(direction) : 0.f;
  };

  std::vector<EdgeCandidate> candidates;
  for (int k = 1; k < 2 * reach; ++k) {
    const float here = std::abs(along[k]);
    if (here < kMinStrength || here < cos_gate * magnitude[k]) continue;
    const float sign = along[k] > 0 ? 1.f : -1.f;
    const float before = sign * along[k - 1];
    const float after = sign * along[k + 1];
    if (before > here || after >= here) continue;
    // The light's peak may lie on the next sample to either side.
    int peak = k - reach;
    std::array<float, 3> light = {
        sign * light_along(peak - 1), sign * light_along(peak), sign * light_along(peak + 1)};
    const int step = light[2] > light[1] ? 1 : light[0] > light[1] ? -1 : 0;
    if (step != 0) {
      peak += step;
      light = {
          sign * light_along(peak - 1), sign * light_along(peak), sign * light_along(peak + 1)};
    }
    const bool has_peak = light[1] > 0 && light[1] >= light[0] && light[1] >= light[2];
    const double offset_cells = has_peak ? peak + PeakShift(light[0], light[1], light[2])
                                         : k - reach + PeakShift(before, here, after);
    const double offset_px = offset_cells * level.scale;
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
