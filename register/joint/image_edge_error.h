// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/edges/aligned_sample.h"

#include <span>

namespace groundglass {

// What one photograph shows of one edge may be something else: a joint beside it, a shadow, a
// gutter before it. Its own error (AlignedSample::bias_px) is therefore taken from Student's t,
// which is a normal distribution of unknown width.
struct ImageEdgeError {
  double widening = 1;  // of bias_px, that these residuals ask for
  double size = 0;      // expected squared error over its two dimensions, in units of bias_px,
                        // far ones at the weight they have left
};

// Expectation maximisation for the multivariate t (Lange, Little and Taylor, JASA 1989).
// samples: of one edge in one photograph; residuals_px: what is left of each, along its normal.
ImageEdgeError EstimateImageEdgeError(std::span<const AlignedSample> samples,
                                      std::span<const double> residuals_px,
                                      double degrees_of_freedom);

}  // namespace groundglass
