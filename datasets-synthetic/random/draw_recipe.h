// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/recipe.h"

namespace groundglass {

// All that the preset `random` leaves to chance, drawn from the seed: building, model, notebook,
// slides or a digital camera, light, surroundings.
SynthRecipe DrawRandomRecipe(uint64_t seed);

}  // namespace groundglass
