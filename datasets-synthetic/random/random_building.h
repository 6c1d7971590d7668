// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/recipe.h"

namespace groundglass {

// The building that a recipe's `random` part describes, with its neighbours, its surroundings, the
// model that people get of it and how that is wrong; and the views of its photographers.
Subject MakeRandomBuilding(const SynthRecipe& recipe);

}  // namespace groundglass
