// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/refine/find_solutions.h"

#include <string>
#include <vector>

namespace groundglass {

struct GroupProfileOptions {
  // Sets of groups with so small or so large a share of what the photograph shows of the model's
  // edges are not asked: the first decide little, and without the others little is left.
  double least_share = 0.08;
  double most_share = 0.9;
  // So many at the most, those with the largest shares.
  int most_sets = 200;
  // How far to both sides a set is moved, and in what steps, sigmas of the model.
  double reach_sigmas = 15;
  double step_sigmas = 0.5;
  // How far, px, its edges may be seen from where a camera sees them: as far as they are moved,
  // within limits. Of what is nearer, less is known farther out.
  double least_spare_px = 30;
  double most_spare_px = 90;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "group profile options: ") const;
};

// How well a photograph suits a set of groups of the model's edges elsewhere than it is drawn.
struct GroupProfile {
  int set = -1;  // in EdgeGroups::sets
  // By offset, from -reach_sigmas in steps: how much more edges and tag say in all than for the
  // best camera, at the camera that the other edges say; nats.
  std::vector<double> gain_nats;
};

// The offset that an entry of gain_nats stands for, sigmas of the model.
double OffsetSigmas(size_t entry, const GroupProfileOptions& options);

// One for each set of which the photograph shows enough. best: the best solution; where a set is
// drawn in the wrong place it has its say in that one, which it has not in the camera without it.
std::vector<GroupProfile> FindGroupProfiles(const Solution& best,
                                            const EdgeModel& edge_model,
                                            const EdgeEvidence& evidence,
                                            const CameraPrior& prior,
                                            const SolutionOptions& solutions,
                                            const GroupProfileOptions& options);

}  // namespace groundglass
