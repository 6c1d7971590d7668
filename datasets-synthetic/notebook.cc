// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/notebook.h"

#include "datasets-synthetic/noise.h"

#include <cmath>

namespace groundglass {

NotebookEntry MakeNotebookEntry(const PlannedView& planned,
                                double aspect,
                                const SynthRecipe& recipe,
                                uint64_t index) {
  const SynthRecipe::Notebook& notebook = recipe.notebook;
  NotebookEntry entry;
  entry.measured.position_in_site = planned.position_in_site;
  entry.measured.lookat_in_site = planned.lookat_in_site;
  entry.measured.aspect = aspect;
  entry.measured.view_angle_deg = planned.view_angle_deg;
  entry.actual = entry.measured;
  const uint64_t seed = SeedFor(recipe.seed, "notebook", index);
  // Without errors of measurement a tape's rounding is none either: the notebook is exact.
  const auto error = [&](double sigma, int which) {
    if (sigma == 0) return 0.0;
    return sigma * NormalOf(HashOf(seed, which, 1)) +
           notebook.tape * (UniformOf(HashOf(seed, which, 2)) - 0.5);
  };
  entry.actual.position_in_site += Eigen::Vector3d(error(notebook.sigma_position, 0),
                                                   error(notebook.sigma_position, 1),
                                                   error(notebook.sigma_height, 2));
  entry.actual.lookat_in_site += Eigen::Vector3d(error(notebook.sigma_lookat, 3),
                                                 error(notebook.sigma_lookat, 4),
                                                 error(notebook.sigma_lookat, 5));
  entry.actual.roll_deg = notebook.sigma_roll_deg * NormalOf(HashOf(seed, 6));
  entry.actual.k1 = recipe.lens.k1;
  return entry;
}

}  // namespace groundglass
