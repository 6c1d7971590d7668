// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/search/uncertainty_ratio.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Sum over the samples of their variance along the normal, px^2.
double SumOfVariances(const CameraPrior& prior, const std::vector<EdgeSample>& samples) {
  const ParameterProjection projection = prior.ProjectionAt(CameraParameters::Zero());
  double sum = 0;
  for (const ProjectedSample& sample : ProjectSamples(samples, projection)) {
    if (sample.is_valid) sum += (sample.jacobian * prior.root).squaredNorm();
  }
  return sum;
}

}  // namespace

double UncertaintyRatio(const ControlPointPosterior& posterior,
                        const CameraPrior& prior,
                        const std::vector<EdgeSample>& samples) {
  const double before = SumOfVariances(prior, samples);
  const double after = SumOfVariances(posterior.prior, samples);
  return before > 0 ? std::min(1.0, std::sqrt(after / before)) : 1;
}

}  // namespace groundglass
