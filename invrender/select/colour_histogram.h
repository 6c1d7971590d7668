// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/consistency_options.h"

#include <Eigen/Dense>

#include <cstdint>
#include <unordered_map>

namespace groundglass {

// The colours that a surface is known to have: a sparse histogram of log radiance.
class ColourHistogram {
 public:
  explicit ColourHistogram(const HistogramOptions& options = {}) : options_(options) {}

  void Add(const Eigen::Array3f& log_radiance, double count = 1);

  // How rare a colour is: 0 for the ordinary ones, up to max_negative_log_likelihood for colours
  // never seen; 0 for all as long as the histogram is empty.
  float NegativeLogLikelihood(const Eigen::Array3f& log_radiance);

 private:
  uint64_t Bin(const Eigen::Array3f& log_radiance, int dx, int dy, int dz) const;

  HistogramOptions options_;
  std::unordered_map<uint64_t, double> counts_;
  std::unordered_map<uint64_t, float> cache_;  // of the bins asked for since the last Add
  double total_ = 0;
};

}  // namespace groundglass
