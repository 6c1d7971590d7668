// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_residuals.h"

#include "scene/weighted_quantile.h"

#include <algorithm>
#include <tuple>

namespace groundglass {

std::vector<SampleResidual> ResidualsOf(std::span<const AlignedSample> samples,
                                        const ParameterProjection& projection) {
  std::vector<SampleResidual> residuals;
  residuals.reserve(samples.size());
  for (const AlignedSample& sample : samples) {
    const auto image_px = projection.ImageOf(sample.point_in_world);
    if (!image_px) continue;
    residuals.push_back({sample.edge,
                         sample.along,
                         *image_px,
                         sample.normal,
                         sample.normal.dot(*image_px - sample.origin_px) - sample.offset_px,
                         sample.precision});
  }
  return residuals;
}

std::optional<ResidualSpread> SpreadOf(std::span<const SampleResidual> residuals) {
  if (residuals.empty()) return std::nullopt;
  std::vector<WeightedValue<double>> values;
  values.reserve(residuals.size());
  for (const SampleResidual& residual : residuals) {
    values.push_back({residual.residual_px, residual.precision});
  }
  return MeasureSpread(std::move(values));
}

std::vector<EdgeResidual> MeanResiduals(std::vector<SampleResidual> residuals,
                                        double piece_px,
                                        double scale) {
  std::erase_if(residuals, [](const SampleResidual& residual) { return residual.precision <= 0; });
  std::stable_sort(residuals.begin(), residuals.end(), [](const auto& a, const auto& b) {
    return std::tie(a.edge, a.along) < std::tie(b.edge, b.along);
  });
  std::vector<EdgeResidual> means;
  for (auto first = residuals.begin(); first != residuals.end();) {
    EdgeResidual sum;
    double precision = 0;
    auto next = first;
    for (; next != residuals.end() && next->edge == first->edge &&
           (next->image_px - first->image_px).norm() < piece_px;
         ++next) {
      sum.image_px += next->precision * next->image_px;
      sum.offset_px -= next->precision * next->residual_px * next->normal;
      precision += next->precision;
    }
    means.push_back({scale / precision * sum.image_px, scale / precision * sum.offset_px});
    first = next;
  }
  return means;
}

}  // namespace groundglass
