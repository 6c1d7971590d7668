// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// A model of longitudes and latitudes, whose format does not say so.
#include "scene/advice/advice_parts.h"
#include "scene/degrees.h"

namespace groundglass {

bool AdviseOnDegrees(const AdviceContext& context) {
  if (!SeemInDegrees(context.bounds)) return false;
  context.Add(Advice::Severity::kScene,
              context.scene.model_file.string(),
              "its x and y are degrees of longitude and latitude, it seems, of which no model can "
              "be made: " +
                  DescribeDegrees(context.bounds),
              std::string(kProjectIt) + "; the tags then count in that system too");
  return true;
}

}  // namespace groundglass
