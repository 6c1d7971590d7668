// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/parameter_projection.h"
#include "register/edges/aligned_sample.h"
#include "register/edges/residual_spread.h"
#include "scene/registration.h"

#include <Eigen/Dense>

#include <optional>
#include <span>
#include <vector>

namespace groundglass {

// What a camera leaves of the distance between a model edge and the photograph's, at one sample.
struct SampleResidual {
  int edge = -1;
  double along = 0;  // where on the edge: -1 at its start, 1 at its end
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();  // where the camera sees the model's edge
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();   // across it
  double residual_px = 0;  // along normal, from the photograph's edge to the model's
  double precision = 0;    // 1 / px^2; 0 for an outlier
};

// Of the samples that the camera sees, in their order.
std::vector<SampleResidual> ResidualsOf(std::span<const AlignedSample> samples,
                                        const ParameterProjection& projection);

// How they scatter, each weighted by its precision; nothing if there are none.
std::optional<ResidualSpread> SpreadOf(std::span<const SampleResidual> residuals);

// To be looked at: the weighted mean of each piece of a model edge that is as long as said in the
// picture, in order of edge. Outliers are left out. scale: of what is returned, from the picture
// that was aligned to the photograph.
std::vector<EdgeResidual> MeanResiduals(std::vector<SampleResidual> residuals,
                                        double piece_px,
                                        double scale);

}  // namespace groundglass
