// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint/joint_state.h"

namespace groundglass {

// Chooses candidates anew about the present solution, within a range that is so much smaller than
// the first (1: the first), and finds anew how large an edge's own error in a photograph is.
void MatchTogether(double shrink, const JointOptions& options, JointState& state);

// Where edges were found farther from the model, more may also be hidden that moves all edges
// together: takes its size from them.
void EstimateSharedOffset(const JointOptions& options, JointState& state);

// Where groups of edges were found nearer to where the model has them than is usual, believes the
// model more from here on (JointOptions::usual_group_quartile_sigmas).
void EstimateGroupOffset(const JointOptions& options, JointState& state);

}  // namespace groundglass
