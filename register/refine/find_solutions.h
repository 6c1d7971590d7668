// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"
#include "register/edges/edge_evidence.h"
#include "register/edges/edge_samples.h"
#include "register/refine/refine_photograph.h"
#include "register/search/hypotheses.h"
#include "register/search/score.h"

#include <functional>
#include <vector>

namespace groundglass {

// The steps by which one photograph's camera is found. Another function in a step's place is
// another method (tests/bench/ablation_bench.cc).
struct SolutionStages {
  std::function<std::vector<Hypothesis>(const std::vector<EdgeSample>&,
                                        const CameraPrior&,
                                        const EdgeEvidence&,
                                        const HypothesisOptions&)>
      find_hypotheses = FindHypotheses;
  std::function<Refinement(const CameraParameters& start,
                           const EdgeModel&,
                           const EdgeEvidence&,
                           const CameraPrior&,
                           const RefineOptions&,
                           const std::vector<ControlPoint>&)>
      refine = RefinePhotograph;
  std::function<AlignmentScore(const std::vector<EdgeSample>&,
                               const ParameterProjection&,
                               const EdgeEvidence&,
                               const ScoreOptions&)>
      score = ScoreAlignment;
};

struct SolutionOptions {
  HypothesisOptions hypotheses;
  RefineOptions refine;
  ScoreOptions score;
  SolutionStages stages;
  // The search moves edges that it sees from the prior's mean: of a frame this much wider on each
  // side, as a share of its width, and this far apart, px.
  double search_frame_share = 0.02;
  double search_spacing_px = 10;
  // Fewer samples than this are no view of the model.
  int min_samples = 10;
  // A solution this far from the best one is another solution, px at a width of 1200.
  double distinct_distance_px = 2.5;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "solution options: ") const;
};

// One refined start with its score.
struct Solution {
  Hypothesis start;  // in the whitened parameters of the prior from the tag
  Refinement refinement;
  AlignmentScore score;
  double control_point_nats = 0;  // log density of what a person pointed at, 0 without

  // The log densities of the prior and of the control points join the edges' score.
  double TotalScore() const {
    return score.nats + control_point_nats - 0.5 * refinement.whitened.squaredNorm();
  }
};

// Where refinement ends from the starts that the search finds in the prior, best first; several may
// end at the same camera. Empty if the tag's camera sees almost nothing of the model.
// points: in pixels of the prior's picture.
std::vector<Solution> FindSolutions(const EdgeModel& edge_model,
                                    const EdgeEvidence& evidence,
                                    const CameraPrior& prior,
                                    const std::vector<ControlPoint>& points,
                                    const SolutionOptions& options);

// Where refinement ends from one start, with its score. points: as above.
Solution SolveFrom(const Hypothesis& start,
                   const EdgeModel& edge_model,
                   const EdgeEvidence& evidence,
                   const CameraPrior& prior,
                   const std::vector<ControlPoint>& points,
                   const SolutionOptions& options);

// The first of the solutions that lies elsewhere than the best one, with how far away it lies on
// average where that one sees edges, in pixels of the priors' picture; null if there is none. Each
// is in whitened parameters of its prior.
struct SecondBest {
  const Solution* solution = nullptr;
  double distance_px = 0;
};
SecondBest FindSecondBest(const Solution& best,
                          const CameraPrior& best_prior,
                          const std::vector<Solution>& solutions,
                          const CameraPrior& prior,
                          const SolutionOptions& options);

}  // namespace groundglass
