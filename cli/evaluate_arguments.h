// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/model_arguments.h"
#include "evaluate/trials.h"
#include "scene/polygon_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// What `evaluate` takes.
struct EvaluateArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  std::vector<std::string> found;
  std::vector<std::string> truths;  // one for each of them; empty: in them or beside them
  std::string model;
  std::string plot_file;            // empty: none
  std::string calibration_file;     // the same, of trials
  std::vector<std::string> beside;  // JSON of other trials, for the calibration plot
  // Monte-Carlo trials of registration; 0: none. `found` is then the scene itself.
  int num_trials = 0;
  TrialOptions trials;
};

// The truth that the `index`-th of what was found is judged by: that which was named, or that in it
// or beside it. Throws Error where there is none.
std::filesystem::path TruthFolder(const EvaluateArguments& arguments, size_t index);

// The polygon model of a scene; its oddities are told on stderr.
PolygonModel ReadModelOf(const EvaluateArguments& arguments,
                         const std::filesystem::path& truth_folder);

// Registers one scene from notebooks that chance draws, and judges that. Returns the exit status.
int EvaluateTrials(const EvaluateArguments& arguments);

// Several scenes, one table: what was found in each, or trials of each. Returns the exit status.
int EvaluateScenes(const EvaluateArguments& arguments);

}  // namespace groundglass
