// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/photograph_plan.h"

#include <vector>

namespace groundglass {

// Everything that a recipe decides before a ray is shot.
struct PlannedScene {
  SyntheticWorld world;  // as photographed: with the relief that the model has not
  PolygonModel model;    // what people get
  std::vector<PhotographPlan> photographs;
  std::vector<PlannedView> novel_views;
};

PlannedScene PlanScene(const SynthRecipe& recipe);

}  // namespace groundglass
