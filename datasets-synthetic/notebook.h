// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/recipe.h"
#include "scene/view_tag.h"

namespace groundglass {

// One line of the field notebook, and where the camera truly was.
struct NotebookEntry {
  ViewTag measured;  // rounded to what the tape gives, roll left out
  ViewTag actual;    // exact, before mount and scanner
};

// The planned numbers are what was written; the truth lies an error of measurement and one of
// rounding away from them, so that a planned view keeps its figures (the thesis' s5).
NotebookEntry MakeNotebookEntry(const PlannedView& planned,
                                double aspect,
                                const SynthRecipe& recipe,
                                uint64_t index);

}  // namespace groundglass
