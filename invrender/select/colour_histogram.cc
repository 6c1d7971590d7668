// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/colour_histogram.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

uint64_t ColourHistogram::Bin(const Eigen::Array3f& log_radiance, int dx, int dy, int dz) const {
  const auto index = [&](float value, int shift) {
    return static_cast<uint64_t>(static_cast<int>(std::floor(value * options_.bins_per_unit)) +
                                 shift + 4096);
  };
  return index(log_radiance[0], dx) << 40 | index(log_radiance[1], dy) << 20 |
         index(log_radiance[2], dz);
}

void ColourHistogram::Add(const Eigen::Array3f& log_radiance, double count) {
  counts_[Bin(log_radiance, 0, 0, 0)] += count;
  total_ += count;
  cache_.clear();
}

float ColourHistogram::NegativeLogLikelihood(const Eigen::Array3f& log_radiance) {
  if (total_ < options_.fewest_counts) return 0;
  const auto [known, is_new] = cache_.try_emplace(Bin(log_radiance, 0, 0, 0), 0.0f);
  if (!is_new) return known->second;
  double count = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        const auto bin = counts_.find(Bin(log_radiance, dx, dy, dz));
        if (bin != counts_.end()) count += bin->second;
      }
    }
  }
  const double share = count / total_;
  known->second = std::clamp(
      static_cast<float>(-std::log((share + options_.unseen_share) / options_.ordinary_share)),
      0.0f,
      options_.max_negative_log_likelihood);
  return known->second;
}

}  // namespace groundglass
