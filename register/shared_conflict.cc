// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/shared_conflict.h"

namespace groundglass {

std::optional<EdgeConflict> FindConflictOf(const AlignedPhotograph& photograph,
                                           const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                                           const EdgeModel& edge_model,
                                           const RegisterOptions& options) {
  return FindEdgeConflict(WithEdgesMoved(photograph.conflict_samples, edge_moves_in_world),
                          edge_model.edges,
                          photograph.prior.ProjectionAt(photograph.whitened),
                          photograph.width_px,
                          options.solutions.score,
                          options.conflict);
}

void JudgeSharedConflict(const ConflictOptions& options,
                         std::vector<PhotographAlignment>& alignments) {
  std::vector<PhotographAlignment*> accepted;
  int num_alike = 0;
  for (PhotographAlignment& alignment : alignments) {
    if (alignment.registration.verdict != Verdict::kAccepted) continue;
    if (alignment.aligned.found.empty()) continue;
    accepted.push_back(&alignment);
    if (alignment.conflict) ++num_alike;
  }
  if (num_alike < options.least_share * static_cast<double>(accepted.size())) return;
  for (PhotographAlignment* alignment : accepted) {
    if (!alignment->conflict) continue;
    EdgeConflict conflict = *alignment->conflict;
    conflict.distance_px *=
        static_cast<double>(alignment->registration.width_px) / alignment->aligned.width_px;
    ApplyJudgement(JudgeConflict(conflict, num_alike, static_cast<int>(accepted.size())),
                   alignment->registration);
  }
}

}  // namespace groundglass
