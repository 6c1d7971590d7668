// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/model_flaw.h"
#include "datasets-synthetic/random/building_faces.h"

namespace groundglass {

// The massing as whoever made the model has it: every plan line, level and window's side off by the
// model's sigma, shared by all that lie on it, so that walls stay flat and upright; and one plan
// line, the main eaves, one wall's windows off by more. What is off by more, and what is left out,
// is told in `flaws`, in the plan's frame.
Massing MeasureMassing(const Massing& massing,
                       const RandomTraits& traits,
                       uint64_t seed,
                       std::vector<ModelFlaw>& flaws);

// What becomes of the photographed building, and of the model.
BuildingDetail DetailOfWorld(const RandomTraits& traits, double relief);
BuildingDetail DetailOfModel(const RandomTraits& traits, double relief);

}  // namespace groundglass
