// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint/joint_refinement.h"
#include "register/photograph_set.h"

namespace groundglass {

// Judges the photographs of a set anew with the cameras of their common solution: what edges and
// other photographs say for each, how far it lies from its tag beside the whole notebook's errors,
// and how much it shares with others beside what these share. Their registrations receive it.
void JudgeMembers(const JointRefinement& joint,
                  const EdgeModel& edge_model,
                  const RegisterOptions& options,
                  const PhotographSet& set);

}  // namespace groundglass
