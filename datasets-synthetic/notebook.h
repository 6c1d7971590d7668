// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/recipe.h"
#include "scene/view_tag.h"

#include <string_view>
#include <vector>

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

// What goes wrong with a pencil, once in a while.
enum class Blunder {
  kNone,
  kSwappedCoordinates,  // x for y of the camera's position
  kWrongSign,           // of its x or y
  kWrongPhotograph,     // the numbers are another photograph's
};
// As truth.json has it: "swapped coordinates", "wrong sign", "wrong photograph"; "none".
std::string_view BlunderName(Blunder blunder);

// Which of the tags get which blunder: `num_blunders` of them, or all if there are fewer; the kinds
// take turns. A wrong photograph needs a second one.
std::vector<Blunder> DrawBlunders(int num_tags, int num_blunders, uint64_t seed);
// Commits the blunders. Coordinates that a swap or a sign would leave within 20 units of where they
// were get the other of the two, so that each blunder is one.
void CommitBlunders(const std::vector<Blunder>& blunders,
                    uint64_t seed,
                    std::vector<ViewTag>& tags);

}  // namespace groundglass
