// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// Where a model is wrong by more than its sigma, for truth.json.
struct ModelFlaw {
  std::string what;   // "wall off", "eaves off", "windows shifted", "missing"
  std::string where;  // "main block wall 2"
  double offset = 0;  // model's unit, along the plan's axis, up, or along the wall; 0 if missing
};

}  // namespace groundglass
