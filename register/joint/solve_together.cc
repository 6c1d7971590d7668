// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/solve_together.h"

#include "register/camera/standard_normal_cost.h"
#include "register/joint/shared_edge_cost.h"
#include "scene/error.h"
#include "scene/text.h"

#include <ceres/ceres.h>

namespace groundglass {
namespace {

// A decoded tag is where it is seen: what may be wrong about it is its survey (AddPriors).
ceres::LossFunction* LossOf(const TiePoint& point, const JointOptions& options) {
  return point.april_tag >= 0 ? nullptr : new ceres::CauchyLoss(options.tie_loss_sigmas);
}

// One cost for each run of matched samples.
SolvedTogether StartProblem(const JointOptions& options, JointState& state) {
  SolvedTogether solved;
  solved.problem = std::make_unique<ceres::Problem>();
  for (const MatchedRun& run : state.runs) {
    MovingPhotograph& moving = state.moving[run.photograph];
    MovingEdge& edge = state.MoverOf(run.edge);
    std::vector<double*> blocks = {
        moving.own.data(), state.lenses[moving.lens].data(), edge.displacement.data()};
    const std::vector<EdgeGroupPart>& groups = state.groups_of_edge[run.edge];
    for (const EdgeGroupPart& part : groups) blocks.push_back(state.groups[part.group].move.data());
    solved.edge_costs.push_back(solved.problem->AddResidualBlock(
        new SharedEdgeCost(run.samples, moving.prior, edge.frame, groups), nullptr, blocks));
  }
  for (size_t i = 0; i < state.ties.size(); ++i) {
    for (const TieObservation& observation : state.tie_points[i].observations) {
      MovingPhotograph& moving = state.moving[observation.photograph];
      MovingTie& tie = state.ties[i];
      solved.tie_costs.push_back(
          solved.problem->AddResidualBlock(new TiePointCost(observation, moving.prior, tie.frame),
                                           LossOf(state.tie_points[i], options),
                                           moving.own.data(),
                                           state.lenses[moving.lens].data(),
                                           tie.move.data()));
    }
  }
  return solved;
}

// Most are where the model has them and a few are far away, but tails end somewhere: no building is
// off by a room. widest: one sigma of what ends them, in units of the scale.
template <int Size>
void AddLongTailedPrior(double widest, double* block, ceres::Problem& problem) {
  problem.AddResidualBlock(new StandardNormalCost<Size>, new ceres::CauchyLoss(1), block);
  problem.AddResidualBlock(
      new StandardNormalCost<Size>,
      new ceres::ScaledLoss(nullptr, 1 / (widest * widest), ceres::TAKE_OWNERSHIP),
      block);
}

// Adds what is known of each block before; returns the order in which blocks are eliminated.
std::shared_ptr<ceres::ParameterBlockOrdering> AddPriors(const JointOptions& options,
                                                         JointState& state,
                                                         ceres::Problem& problem) {
  // Ceres orders the blocks of a group by their addresses: each group is one array, so that the
  // order, and with it the rounding, is the same in every run. What many photographs have in common
  // comes after them: eliminated before them, it would fill the matrix of all.
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  if (problem.HasParameterBlock(state.ground.displacement.data())) {
    problem.AddResidualBlock(new StandardNormalCost<4>, nullptr, state.ground.displacement.data());
    ordering->AddElementToGroup(state.ground.displacement.data(), 3);
  }
  for (MovingEdge& edge : state.edges) {
    double* block = edge.displacement.data();
    if (!problem.HasParameterBlock(block)) continue;
    AddLongTailedPrior<4>(
        options.widest_offset_sigmas / options.common_offset_sigmas, block, problem);
    ordering->AddElementToGroup(block, 0);
  }
  for (MovingGroup& group : state.groups) {
    double* block = group.move.data();
    if (!problem.HasParameterBlock(block)) continue;
    const double widest = options.widest_offset_sigmas / state.group_offset_sigmas;
    if (group.num_numbers == 1) {
      AddLongTailedPrior<1>(widest, block, problem);
    } else {
      AddLongTailedPrior<2>(widest, block, problem);
    }
    ordering->AddElementToGroup(block, 2);
  }
  for (size_t i = 0; i < state.ties.size(); ++i) {
    MovingTie& tie = state.ties[i];
    ordering->AddElementToGroup(tie.move.data(), 0);
    if (state.tie_points[i].april_tag >= 0) {
      problem.AddResidualBlock(new StandardNormalCost<3>,
                               new ceres::CauchyLoss(options.survey_loss_sigmas),
                               tie.move.data());
      continue;
    }
    problem.AddResidualBlock(
        new ReliefPriorCost(options.widest_relief_sigmas), nullptr, tie.move.data());
    problem.AddResidualBlock(
        new ReliefPriorCost(1), new ceres::CauchyLoss(options.relief_sigmas), tie.move.data());
  }
  for (MovingPhotograph& moving : state.moving) {
    problem.AddResidualBlock(
        new StandardNormalCost<kNumCameraParameters>, nullptr, moving.own.data());
    ordering->AddElementToGroup(moving.own.data(), 1);
  }
  for (LensParameters& lens : state.lenses) {
    problem.AddResidualBlock(new StandardNormalCost<kNumLensParameters>, nullptr, lens.data());
    ordering->AddElementToGroup(lens.data(), 4);
  }
  return ordering;
}

}  // namespace

SolvedTogether SolveTogether(const JointOptions& options, JointState& state) {
  SolvedTogether solved = StartProblem(options, state);
  ceres::Solver::Options solver;
  solver.linear_solver_ordering = AddPriors(options, state, *solved.problem);
  // Photographs at two ends of a street share no edge: most of what is left of many is empty.
  solver.linear_solver_type = ceres::SPARSE_SCHUR;
  solver.max_num_iterations = 6;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, solved.problem.get(), &summary);
  if (!summary.IsSolutionUsable()) {
    throw Error("register: the photographs' common solution was not found: " +
                OneLine(summary.message));
  }
  return solved;
}

}  // namespace groundglass
