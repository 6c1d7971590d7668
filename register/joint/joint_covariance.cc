// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/joint_covariance.h"

#include "register/edges/edge_clusters.h"
#include "register/joint/covariance_excess.h"
#include "register/joint/normal_equations.h"
#include "register/refine/systematic_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// The problem's blocks; the state's arrays are the problem's own. No cost holds two edges, or two
// ties, or one of each.
NormalEquations EquationsOf(JointState& state, ceres::Problem& problem) {
  std::vector<double*> eliminated;
  for (MovingEdge& edge : state.edges) {
    double* block = edge.displacement.data();
    if (problem.HasParameterBlock(block)) eliminated.push_back(block);
  }
  for (MovingTie& tie : state.ties) eliminated.push_back(tie.move.data());
  std::vector<double*> kept;
  for (MovingGroup& group : state.groups) {
    if (problem.HasParameterBlock(group.move.data())) kept.push_back(group.move.data());
  }
  double* ground = state.ground.displacement.data();
  if (problem.HasParameterBlock(ground)) kept.push_back(ground);
  for (MovingPhotograph& moving : state.moving) kept.push_back(moving.own.data());
  for (LensParameters& lens : state.lenses) kept.push_back(lens.data());
  return NormalEquations(problem, eliminated, kept);
}

// What all edges may lie off together (WhitenedSystematicModes).
Eigen::MatrixXd SystematicModes(const NormalEquations& equations,
                                const JointState& state,
                                const SolvedTogether& solved) {
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(equations.Residuals().size(), kNumSystematicModes);
  for (size_t i = 0; i < state.runs.size(); ++i) {
    const auto [first, size] = equations.RowsOfCosts().at(solved.edge_costs[i]);
    const CameraPrior& prior = state.photographs[state.runs[i].photograph].prior;
    modes.middleRows(first, size) =
        WhitenedSystematicModes(state.runs[i].samples, prior.width_px, prior.height_px);
  }
  return modes;
}

// The residuals of what errs together: edges of a cluster in one photograph; what it has in common
// with others on one face, by what stands out from it and by what the light does there; an
// AprilTag's corners.
using Clusters = std::vector<std::vector<NormalEquations::Rows>>;

Clusters FindClusters(const NormalEquations& equations,
                      const JointState& state,
                      const SolvedTogether& solved) {
  const std::vector<int> clusters =
      FindEdgeClusters(state.edge_model.model, state.edge_model.edges);
  std::map<std::pair<size_t, int>, std::vector<NormalEquations::Rows>> rows_of_cluster;
  for (size_t i = 0; i < state.runs.size(); ++i) {
    rows_of_cluster[{state.runs[i].photograph, clusters[state.runs[i].edge]}].push_back(
        equations.RowsOfCosts().at(solved.edge_costs[i]));
  }
  const int num_clusters =
      clusters.empty() ? 0 : *std::max_element(clusters.begin(), clusters.end()) + 1;
  const int num_faces = static_cast<int>(state.edge_model.model.faces.size());
  size_t tie_cost = 0;
  for (const TiePoint& point : state.tie_points) {
    for (const TieObservation& observation : point.observations) {
      const int number = point.april_tag >= 0 ? num_faces + point.april_tag : point.face;
      rows_of_cluster[{observation.photograph, num_clusters + number}].push_back(
          equations.RowsOfCosts().at(solved.tie_costs[tie_cost++]));
    }
  }
  Clusters rows;
  for (auto& [cluster, of_cluster] : rows_of_cluster) rows.push_back(std::move(of_cluster));
  return rows;
}

// What is left of a cluster does not average out: how far the solution would move without each (the
// jackknife by clusters, CR3: Bell and McCaffrey, Survey Methodology 2002). What is left alone is
// too little where a cluster decides much: the camera has followed it.
Eigen::MatrixXd LeaveOutUpdates(const NormalEquations& equations, const Clusters& clusters) {
  Eigen::MatrixXd moves(equations.NumKept(), static_cast<Eigen::Index>(clusters.size()));
  tbb::parallel_for(size_t{0}, clusters.size(), [&](size_t i) {
    moves.col(static_cast<Eigen::Index>(i)) = equations.LeaveOutUpdate(clusters[i]);
  });
  return moves;
}

// What all clusters add to the normal equations.
Eigen::SparseMatrix<double> InformationOf(const NormalEquations& equations,
                                          const Clusters& clusters) {
  std::vector<NormalEquations::Rows> rows;
  for (const auto& cluster : clusters) rows.insert(rows.end(), cluster.begin(), cluster.end());
  return equations.InformationOf(rows);
}

constexpr int kNumParts = kNumCameraParameters + kNumLensParameters;

// Of a photograph's own parameters and its lens's. by_mode, by_cluster: what all that is kept moves
// by; information: of all clusters.
Eigen::MatrixXd CovarianceOfParts(const MovingPhotograph& moving,
                                  const JointState& state,
                                  const NormalEquations& equations,
                                  const Eigen::MatrixXd& by_mode,
                                  const Eigen::MatrixXd& by_cluster,
                                  const Eigen::SparseMatrix<double>& information) {
  const Eigen::Index own = equations.ColumnOf(moving.own.data());
  const Eigen::Index lens = equations.ColumnOf(state.lenses[moving.lens].data());
  const auto rows_of_parts = [&](const Eigen::MatrixXd& columns) {
    Eigen::MatrixXd rows(kNumParts, columns.cols());
    rows << columns.middleRows<kNumCameraParameters>(own),
        columns.middleRows<kNumLensParameters>(lens);
    return rows;
  };
  Eigen::MatrixXd columns(equations.NumKept(), kNumParts);
  columns << equations.Covariance().middleCols<kNumCameraParameters>(own),
      equations.Covariance().middleCols<kNumLensParameters>(lens);
  Eigen::MatrixXd covariance = rows_of_parts(columns);
  const Eigen::MatrixXd shared = rows_of_parts(by_mode);
  const Eigen::MatrixXd cluster = rows_of_parts(by_cluster);
  // The normal equations count on residuals of the size that they are given already: the jackknife
  // measures the same errors again, and adds what it finds beyond that.
  covariance +=
      shared * shared.transpose() + CovarianceExcess(cluster * cluster.transpose(),
                                                     columns.transpose() * (information * columns),
                                                     covariance);
  return covariance;
}

// A photograph's matched samples, as its camera sees them, from the model's edges as the model has
// them.
std::vector<SampleResidual> ResidualsOfPhotograph(size_t p, const JointState& state) {
  const ParameterProjection projection = state.ProjectionOf(state.moving[p]);
  std::vector<SampleResidual> residuals;
  for (const MatchedRun& run : state.runs) {
    if (run.photograph != p) continue;
    const std::vector<SampleResidual> of_run = ResidualsOf(run.samples, projection);
    residuals.insert(residuals.end(), of_run.begin(), of_run.end());
  }
  return residuals;
}

// Of where an edge's middle lies off: its own displacement and its groups'.
Eigen::Matrix3d CovarianceOfMiddle(int edge,
                                   const JointState& state,
                                   const NormalEquations& equations) {
  const MovingEdge& mover = state.MoverOf(edge);
  Eigen::MatrixXd of_displacement = Eigen::MatrixXd::Zero(mover.displacement.size(), 3);
  of_displacement.topRows<2>() = mover.frame.across.transpose();
  std::vector<NormalEquations::Directions> sums = {
      {mover.displacement.data(), std::move(of_displacement)}};
  for (const EdgeGroupPart& part : state.groups_of_edge[edge]) {
    sums.push_back({state.groups[part.group].move.data(), part.directions.transpose()});
  }
  return equations.CovarianceOfSums(sums);
}

}  // namespace

JointRefinement SummariseTogether(JointState& state, SolvedTogether& solved) {
  const NormalEquations equations = EquationsOf(state, *solved.problem);
  const Eigen::MatrixXd by_mode =
      equations.LinearResponse(SystematicModes(equations, state, solved).sparseView());
  const Clusters clusters = FindClusters(equations, state, solved);
  const Eigen::MatrixXd by_cluster = LeaveOutUpdates(equations, clusters);
  const Eigen::SparseMatrix<double> information = InformationOf(equations, clusters);

  JointRefinement joint;
  joint.photographs.resize(state.moving.size());
  tbb::parallel_for(size_t{0}, state.moving.size(), [&](size_t p) {
    const MovingPhotograph& moving = state.moving[p];
    const Eigen::MatrixXd whole = moving.prior.whole_from_parts;
    // Of sizes known at run time only: products of each fixed size take the compiler seconds.
    Eigen::VectorXd parts(kNumParts);
    parts << moving.own, state.lenses[moving.lens];
    joint.photographs[p] = {
        whole * parts,
        whole * CovarianceOfParts(moving, state, equations, by_mode, by_cluster, information) *
            whole.transpose(),
        moving.num_matched,
        ResidualsOfPhotograph(p, state)};
  });
  for (size_t edge = 0; edge < state.edges.size(); ++edge) {
    joint.group_moves_in_world.push_back(state.GroupMoveOf(static_cast<int>(edge)));
  }
  for (const MovingTie& tie : state.ties) {
    joint.tie_moves_in_world.push_back(tie.frame.axes_in_world * tie.move);
  }
  std::vector<std::vector<int>> shown_in(state.edges.size());
  for (const MatchedRun& run : state.runs) {
    shown_in[run.edge].push_back(static_cast<int>(run.photograph));
  }
  for (size_t number = 0; number < state.edges.size(); ++number) {
    if (shown_in[number].empty()) continue;
    const int edge = static_cast<int>(number);
    joint.displacements.push_back({edge,
                                   state.DisplacementOf(edge, -1),
                                   state.DisplacementOf(edge, 1),
                                   CovarianceOfMiddle(edge, state, equations),
                                   std::move(shown_in[number])});
  }
  return joint;
}

}  // namespace groundglass
