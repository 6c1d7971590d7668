// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/photograph_plan.h"
#include "datasets-synthetic/wall_tags.h"

#include <optional>
#include <vector>

namespace groundglass {

// Everything that a recipe decides before a ray is shot.
struct PlannedScene {
  SyntheticWorld world;  // as photographed: with the relief that the model has not
  PolygonModel model;    // what people get
  // The same without errors, where it has some, and the large ones.
  std::optional<PolygonModel> exact_model;
  std::vector<ModelFlaw> model_flaws;
  Box built;  // what stands there, neighbours too
  std::vector<PhotographPlan> photographs;
  std::vector<PlannedView> novel_views;
  std::vector<WallTag> wall_tags;
};

PlannedScene PlanScene(const SynthRecipe& recipe);

}  // namespace groundglass
