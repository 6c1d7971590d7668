// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/advice_suitability.h"

#include "scene/quantile.h"

#include <algorithm>

namespace groundglass {
namespace {

Suitability Summarise(const std::vector<Standpoint>& standpoints) {
  // As a share of the distance looked at: hand-written points are met within a fifth of it.
  constexpr double kMet = 0.12;
  Suitability summary{0, 0, 1, 0, 0};
  const double count = static_cast<double>(standpoints.size());
  std::vector<double> errors;
  double model_share = 0;
  double front_share = 0;
  for (const Standpoint& standpoint : standpoints) {
    summary.implausible_share += IsImplausible(standpoint) ? 1 / count : 0;
    summary.plausible_share += IsPlausible(standpoint) ? 1 / count : 0;
    if (IsPlausible(standpoint)) {
      summary.votes += std::max(0.0, 1 - standpoint.lookat_error / kMet) / count;
    }
    errors.push_back(standpoint.lookat_error);
    model_share += standpoint.model_share;
    front_share += standpoint.model_share * standpoint.front_share;
  }
  summary.median_lookat_error = UpperMedian(std::move(errors));
  summary.front_share = model_share > 0 ? front_share / model_share : 0;
  return summary;
}

}  // namespace

Suitability FindSuitability(const AdviceContext& context,
                            const std::vector<const Photograph*>& photographs,
                            const OtherReading& model,
                            const Retag& retag) {
  std::vector<Standpoint> standpoints;
  for (const Photograph* photograph : photographs) {
    const ViewTag tag = retag ? retag(photograph->tag) : photograph->tag;
    if (FindTagFault(tag)) continue;
    standpoints.push_back(FindStandpoint(
        context.bounds, context.visibility, context.scene.model, tag, photograph->size, model));
  }
  return standpoints.empty() ? Suitability{} : Summarise(standpoints);
}

std::vector<const Photograph*> SomePhotographs(const Scene& scene) {
  constexpr size_t kMostTags = 40;
  const size_t total = scene.photographs.size();
  const size_t count = std::min(total, kMostTags);
  std::vector<const Photograph*> some;
  for (size_t i = 0; i < count; ++i) some.push_back(&scene.photographs[i * total / count]);
  return some;
}

}  // namespace groundglass
