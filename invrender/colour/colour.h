// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/colour_options.h"
#include "invrender/measure/chart_blocks.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// How the photographs' colours relate. With r^2 as in PreparedPhoto::RadiusSquared,
//   log radiance = log colour of the wall + log_gain + vignetting r^2 + face_gain
struct ColourModel {
  struct Photo {
    Eigen::Array3f log_gain = Eigen::Array3f::Zero();
    Eigen::Array3f vignetting = Eigen::Array3f::Zero();
    // How far one gain is from explaining all faces (log units): sun does that, haze does not.
    double nonuniformity = 0;
  };
  std::vector<Photo> photos;
  // [chart][k]: how the light of photograph blocks[chart].photos[k] fell on this chart.
  std::vector<std::vector<Eigen::Array3f>> face_gains;

  // What to multiply radiance by.
  Eigen::Array3f Correction(int photo, int chart, int k, double radius_squared) const {
    const Photo& p = photos[photo];
    return (-(p.log_gain + p.vignetting * static_cast<float>(radius_squared) +
              face_gains[chart][k]))
        .exp();
  }
  // The logarithm of a block's colour, corrected.
  Eigen::Array3f Corrected(int photo, int chart, int k, const BlockView& view) const {
    const Photo& p = photos[photo];
    return view.log_radiance - p.log_gain - p.vignetting * view.radius_squared -
           face_gains[chart][k];
  }
};

// All gains zero.
ColourModel MakeNeutralColour(const std::vector<ChartBlocks>& blocks, size_t num_photos);

// Least squares over every block that two photographs or more show, in log-linear light, robust
// (iteratively reweighted, the scale annealed), the blocks' own colours eliminated. The mean of all
// gains is the anchor, as Brown and Lowe do (IJCV 2007, section 6). Then a gain for each
// photograph and chart around the blocks' weighted medians, where photographs whose light is even
// weigh more.
ColourModel EstimateColour(const std::vector<ChartBlocks>& blocks,
                           size_t num_photos,
                           const ColourOptions& options);

}  // namespace groundglass
