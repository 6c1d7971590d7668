// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint/joint_solution.h"
#include "register/joint/joint_state.h"
#include "register/joint/solve_together.h"

namespace groundglass {

// What came of a joint solve, with covariances: those of the normal equations, widened by what all
// edges may lie off together (refine/systematic_error.h), and by what edges of a cluster have in
// common (the jackknife). Throws Error if something is not determined.
JointRefinement SummariseTogether(JointState& state, SolvedTogether& solved);

}  // namespace groundglass
