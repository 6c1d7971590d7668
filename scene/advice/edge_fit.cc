// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/edge_fit.h"

#include "scene/quantile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

// So coarse that a hand-written tag is a few pixels off, and a roll of a degree is none.
constexpr int kLongSidePx = 256;
// How far the edges are moved each way, as a share of the long side.
constexpr double kReach = 0.12;
constexpr double kSampleSpacingPx = 2;
constexpr size_t kFewestSamples = 60;
constexpr size_t kMostSamples = 1500;

// Means over the pixels of the large picture that each pixel of the small one covers.
std::vector<float> Reduced(const Image8& grey8, int width, int height) {
  std::vector<float> sums(static_cast<size_t>(width) * height, 0.0f);
  std::vector<float> counts(sums.size(), 0.0f);
  for (int y = 0; y < grey8.height; ++y) {
    const size_t row = static_cast<size_t>(static_cast<long long>(y) * height / grey8.height) *
                       static_cast<size_t>(width);
    for (int x = 0; x < grey8.width; ++x) {
      const size_t at = row + static_cast<size_t>(static_cast<long long>(x) * width / grey8.width);
      sums[at] += *grey8.At(x, y);
      counts[at] += 1;
    }
  }
  for (size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1.0f, counts[i]);
  return sums;
}

struct EdgeSample {
  float x = 0;
  float y = 0;
  int direction = 0;
};

}  // namespace

EdgeFit::EdgeFit(const Image8& grey8) {
  const double scale =
      std::min(1.0, static_cast<double>(kLongSidePx) / std::max(grey8.width, grey8.height));
  width_ = std::max(1, static_cast<int>(std::lround(grey8.width * scale)));
  height_ = std::max(1, static_cast<int>(std::lround(grey8.height * scale)));
  const std::vector<float> grey = Reduced(grey8, width_, height_);
  const auto at = [&](int x, int y) {
    return grey[static_cast<size_t>(std::clamp(y, 0, height_ - 1)) * width_ +
                std::clamp(x, 0, width_ - 1)];
  };
  std::vector<float> right(grey.size());
  std::vector<float> down(grey.size());
  std::vector<float> sizes;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const size_t i = static_cast<size_t>(y) * width_ + x;
      right[i] = (at(x + 1, y - 1) + 2 * at(x + 1, y) + at(x + 1, y + 1)) -
                 (at(x - 1, y - 1) + 2 * at(x - 1, y) + at(x - 1, y + 1));
      down[i] = (at(x - 1, y + 1) + 2 * at(x, y + 1) + at(x + 1, y + 1)) -
                (at(x - 1, y - 1) + 2 * at(x, y - 1) + at(x + 1, y - 1));
      sizes.push_back(std::hypot(right[i], down[i]));
    }
  }
  // Half strength at the picture's stronger gradients: a bright sky's rim counts no more than a
  // wall's.
  const size_t upper = sizes.size() * 4 / 5;
  const float half = std::max(1.0f, ValueOfRank(std::move(sizes), upper));
  for (int direction = 0; direction < kDirections; ++direction) {
    const double angle = std::numbers::pi * direction / kDirections;
    const float c = static_cast<float>(std::cos(angle));
    const float s = static_cast<float>(std::sin(angle));
    std::vector<float> own(grey.size());
    for (size_t i = 0; i < grey.size(); ++i) {
      const float along = right[i] * c + down[i] * s;
      const float size = std::hypot(right[i], down[i]);
      // Squared cosine: only gradients across the edge count.
      own[i] = size > 0 ? along * along / (size * (size + half)) : 0.0f;
    }
    // A pixel to either side does as well.
    std::vector<float>& wide = strength_.emplace_back(grey.size(), 0.0f);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        float most = 0;
        for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v) {
          for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
            most = std::max(most, own[static_cast<size_t>(v) * width_ + u]);
          }
        }
        wide[static_cast<size_t>(y) * width_ + x] = most;
      }
    }
  }
}

double EdgeFit::Score(const PolygonModel& model,
                      const std::vector<ModelEdge>& edges,
                      const Visibility& visibility,
                      const Camera& camera,
                      double nearness) const {
  const Camera small = ResizedCamera(camera, width_, height_);
  std::vector<EdgeSample> samples;
  for (const VisibleSpan& span : FindVisibleSpans(model, edges, visibility, small, 0)) {
    const auto start = Project(small, span.start_in_world);
    const auto end = Project(small, span.end_in_world);
    if (!start || !end) continue;
    const Eigen::Vector2d along = *end - *start;
    const int count = static_cast<int>(along.norm() / kSampleSpacingPx);
    if (count < 2) continue;
    // The normal's angle, modulo half a turn.
    const double angle = std::atan2(along.y(), along.x()) + std::numbers::pi / 2;
    const int direction =
        static_cast<int>(std::lround(angle / std::numbers::pi * kDirections)) + 4 * kDirections;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d point = *start + along * ((i + 0.5) / count);
      samples.push_back(
          {static_cast<float>(point.x()), static_cast<float>(point.y()), direction % kDirections});
    }
  }
  if (samples.size() < kFewestSamples) return 0;
  const size_t stride = (samples.size() + kMostSamples - 1) / kMostSamples;

  const int reach = static_cast<int>(kReach * std::max(width_, height_));
  double sum = 0;
  double sum_of_squares = 0;
  double best = 0;
  int num_places = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      double total = 0;
      int count = 0;
      for (size_t i = 0; i < samples.size(); i += stride) {
        const int x = static_cast<int>(samples[i].x) + dx;
        const int y = static_cast<int>(samples[i].y) + dy;
        if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
        total += strength_[static_cast<size_t>(samples[i].direction)]
                          [static_cast<size_t>(y) * width_ + x];
        ++count;
      }
      if (count < static_cast<int>(samples.size() / stride) / 2) continue;
      const double mean = total / count;
      sum += mean;
      sum_of_squares += mean * mean;
      const bool is_near = std::max(std::abs(dx), std::abs(dy)) <= nearness * reach;
      if (is_near) best = std::max(best, mean);
      ++num_places;
    }
  }
  if (num_places < 100) return 0;
  const double mean = sum / num_places;
  const double variance = sum_of_squares / num_places - mean * mean;
  return variance > 1e-12 ? (best - mean) / std::sqrt(variance) : 0;
}

Image8 UpsideDown(const Image8& picture) {
  Image8 turned(picture.width, picture.height, picture.channels);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::copy_n(picture.At(picture.width - 1 - x, picture.height - 1 - y),
                  picture.channels,
                  turned.At(x, y));
    }
  }
  return turned;
}

Image8 MirroredPicture(const Image8& picture) {
  Image8 mirrored(picture.width, picture.height, picture.channels);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::copy_n(picture.At(picture.width - 1 - x, y), picture.channels, mirrored.At(x, y));
    }
  }
  return mirrored;
}

}  // namespace groundglass
