// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint_refinement.h"

#include "register/shared_bias.h"
#include "register/shared_edge_cost.h"
#include "register/standard_normal_cost.h"
#include "register/weighted_median.h"

#include <Eigen/Sparse>
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace groundglass {
namespace {

// A model edge as the solve moves it.
struct MovingEdge {
  EdgeFrame frame;
  Eigen::Vector4d displacement = Eigen::Vector4d::Zero();  // in units of the frame's scale
  int num_photographs = 0;                                 // that matched it in the last round
};

// A photograph as the solve moves it.
struct MovingPhotograph {
  PartedPrior prior;
  CameraParameters own = CameraParameters::Zero();
  int lens = 0;
  double noise_px = 0;
  int num_matched = 0;
};

// One run of samples of one edge in one photograph, matched.
struct MatchedRun {
  size_t photograph = 0;
  int edge = -1;
  std::vector<AlignedSample> samples;
};

EdgeFrame FrameOfEdge(const PolygonModel& model,
                      const ModelEdge& edge,
                      const JointOptions& options) {
  const double scale_units = options.common_offset_m / MetresPerUnit(model.unit);
  const Eigen::Vector3d direction = (edge.end_in_world - edge.start_in_world).normalized();
  const Eigen::Vector3d first = direction.unitOrthogonal();
  EdgeFrame frame;
  frame.across.col(0) = scale_units * first;
  frame.across.col(1) = scale_units * direction.cross(first);
  frame.turn_ratio = options.common_turn_m / options.common_offset_m;
  return frame;
}

class JointSolver {
 public:
  JointSolver(const EdgeModel& edge_model,
              const std::vector<AlignedPhotograph>& photographs,
              const std::vector<int>& lenses,
              const JointOptions& options)
      : photographs_(photographs),
        options_(options),
        own_bias_(options.own),
        units_per_metre_(1 / MetresPerUnit(edge_model.model.unit)),
        edges_(edge_model.edges.size()) {
    const LensParameters own_shares(
        options.own_view_angle_share, options.own_aspect_share, options.own_k1_share);
    for (size_t p = 0; p < photographs.size(); ++p) {
      const AlignedPhotograph& photograph = photographs[p];
      moving_.push_back({PartPrior(photograph.prior, own_shares),
                         photograph.whitened,
                         lenses[p],
                         photograph.noise_px,
                         0});
      for (const CandidateSample& found : photograph.found) {
        const int edge = found.sample.edge;
        edges_[edge].frame = FrameOfEdge(edge_model.model, edge_model.edges[edge], options);
      }
    }
    StartLenses();
  }

  // Chooses candidates anew about the present solution.
  void Match(double range_px) {
    runs_.clear();
    for (MovingEdge& edge : edges_) edge.num_photographs = 0;
    for (size_t p = 0; p < photographs_.size(); ++p) MatchPhotograph(p, range_px);
  }

  // Moves everything, candidates held. Leaves the problem for Covariances.
  void Solve() {
    problem_ = std::make_unique<ceres::Problem>();
    edge_costs_.clear();
    for (const MatchedRun& run : runs_) {
      const AlignedPhotograph& photograph = photographs_[run.photograph];
      MovingPhotograph& moving = moving_[run.photograph];
      MovingEdge& edge = edges_[run.edge];
      edge_costs_.push_back(problem_->AddResidualBlock(new SharedEdgeCost(run.samples,
                                                                          moving.prior,
                                                                          edge.frame,
                                                                          photograph.measured.k2,
                                                                          photograph.width_px,
                                                                          photograph.height_px),
                                                       nullptr,
                                                       moving.own.data(),
                                                       lenses_[moving.lens].data(),
                                                       edge.displacement.data()));
    }
    // Ceres orders the blocks of a group by their addresses: each group is one array, so that the
    // order, and with it the rounding, is the same in every run.
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (MovingEdge& edge : edges_) {
      double* block = edge.displacement.data();
      if (!problem_->HasParameterBlock(block)) continue;
      problem_->AddResidualBlock(new StandardNormalCost<4>, new ceres::CauchyLoss(1), block);
      // Tails end somewhere: no building is off by a room.
      const double widest = options_.widest_offset_m / options_.common_offset_m;
      problem_->AddResidualBlock(
          new StandardNormalCost<4>,
          new ceres::ScaledLoss(nullptr, 1 / (widest * widest), ceres::TAKE_OWNERSHIP),
          block);
      ordering->AddElementToGroup(block, 0);
    }
    for (MovingPhotograph& moving : moving_) {
      problem_->AddResidualBlock(
          new StandardNormalCost<kNumCameraParameters>, nullptr, moving.own.data());
      ordering->AddElementToGroup(moving.own.data(), 1);
    }
    for (LensParameters& lens : lenses_) {
      problem_->AddResidualBlock(new StandardNormalCost<kNumLensParameters>, nullptr, lens.data());
      ordering->AddElementToGroup(lens.data(), 2);
    }
    ceres::Solver::Options solver;
    solver.linear_solver_ordering = ordering;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.max_num_iterations = 6;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, problem_.get(), &summary);
  }

  // Where edges were found farther from the model, more may also be hidden that moves all edges
  // together: takes its size from them.
  void EstimateSharedOffset();

  JointRefinement Result();

 private:
  void StartLenses();
  void MatchPhotograph(size_t p, double range_px);

  const std::vector<AlignedPhotograph>& photographs_;
  const JointOptions& options_;
  EdgeBias own_bias_;
  double units_per_metre_;
  std::vector<MovingPhotograph> moving_;
  std::vector<LensParameters> lenses_;
  std::vector<MovingEdge> edges_;  // for each of EdgeModel::edges
  std::vector<MatchedRun> runs_;
  std::unique_ptr<ceres::Problem> problem_;
  std::vector<ceres::ResidualBlockId> edge_costs_;  // one for each run
};

// Each lens starts at the mean of what its photographs found by themselves.
void JointSolver::StartLenses() {
  int num_lenses = 0;
  for (const MovingPhotograph& moving : moving_) num_lenses = std::max(num_lenses, moving.lens + 1);
  lenses_.assign(num_lenses, LensParameters::Zero());
  std::vector<int> counts(num_lenses, 0);
  for (size_t p = 0; p < moving_.size(); ++p) {
    const CameraParameters change = photographs_[p].prior.root * photographs_[p].whitened;
    const auto& lens_root = moving_[p].prior.lens_root;
    lenses_[moving_[p].lens] += lens_root.completeOrthogonalDecomposition().solve(change);
    ++counts[moving_[p].lens];
  }
  for (int i = 0; i < num_lenses; ++i) lenses_[i] /= std::max(1, counts[i]);
}

void JointSolver::MatchPhotograph(size_t p, double range_px) {
  const AlignedPhotograph& photograph = photographs_[p];
  MovingPhotograph& moving = moving_[p];
  const ParameterProjection projection(moving.prior.Camera(moving.own, lenses_[moving.lens]),
                                       photograph.measured.k2,
                                       photograph.width_px,
                                       photograph.height_px);
  std::vector<WeightedValue> residuals;
  moving.num_matched = 0;
  const std::vector<CandidateSample>& found = photograph.found;
  for (size_t start = 0; start < found.size();) {
    MatchedRun run{p, found[start].sample.edge, {}};
    MovingEdge& edge = edges_[run.edge];
    size_t end = start;
    for (; end < found.size() && found[end].sample.edge == run.edge; ++end) {
      const CandidateSample& sample = found[end];
      const auto projected =
          projection.Project(sample.sample.point_in_world +
                             edge.frame.Displacement(edge.displacement, sample.sample.along));
      if (!projected) continue;
      const double predicted_px = sample.normal.dot(projected->image_px - sample.origin_px);
      const SoftMatch match =
          MatchCandidates(sample, predicted_px, range_px, moving.noise_px, options_.matching);
      if (!(match.precision > 0)) continue;
      run.samples.push_back(MakeAlignedSample(sample, match, units_per_metre_, own_bias_));
      residuals.push_back({std::abs(match.offset_px - predicted_px), match.precision});
    }
    start = end;
    if (run.samples.empty()) continue;
    moving.num_matched += static_cast<int>(run.samples.size());
    ++edge.num_photographs;
    runs_.push_back(std::move(run));
  }
  moving.noise_px = std::clamp(1.4826 * WeightedMedian(std::move(residuals), 1),
                               options_.min_noise_px,
                               options_.matching.final_range_px / 2);
}

void JointSolver::EstimateSharedOffset() {
  std::vector<double> offsets_m;
  for (const MovingEdge& edge : edges_) {
    if (edge.num_photographs < 2) continue;
    offsets_m.push_back(edge.frame.Displacement(edge.displacement, 0).norm() / units_per_metre_);
  }
  if (offsets_m.empty()) return;
  const auto quartile = offsets_m.begin() + static_cast<std::ptrdiff_t>(offsets_m.size() * 3 / 4);
  std::nth_element(offsets_m.begin(), quartile, offsets_m.end());
  own_bias_.shared_offset_m =
      std::clamp(*quartile, options_.least_shared_offset_m, options_.most_shared_offset_m);
}

JointRefinement JointSolver::Result() {
  // Normal equations of everything at the solution, and the residuals' answer to what all edges
  // may lie off together.
  ceres::Problem::EvaluateOptions evaluate;
  problem_->GetResidualBlocks(&evaluate.residual_blocks);
  std::map<const double*, int> column_of_block;
  int num_columns = 0;
  const auto add_block = [&](double* block, int size) {
    evaluate.parameter_blocks.push_back(block);
    column_of_block[block] = num_columns;
    num_columns += size;
  };
  for (MovingEdge& edge : edges_) {
    if (problem_->HasParameterBlock(edge.displacement.data())) {
      add_block(edge.displacement.data(), 4);
    }
  }
  for (MovingPhotograph& moving : moving_) add_block(moving.own.data(), kNumCameraParameters);
  for (LensParameters& lens : lenses_) add_block(lens.data(), kNumLensParameters);
  ceres::CRSMatrix rows;
  problem_->Evaluate(evaluate, nullptr, nullptr, nullptr, &rows);
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> jacobian(
      rows.num_rows,
      rows.num_cols,
      static_cast<Eigen::Index>(rows.values.size()),
      rows.rows.data(),
      rows.cols.data(),
      rows.values.data());
  const Eigen::SparseMatrix<double> information = jacobian.transpose() * jacobian;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(information);

  Eigen::MatrixXd pushes = Eigen::MatrixXd::Zero(rows.num_rows, kNumSharedPushes);
  std::map<ceres::ResidualBlockId, size_t> run_of_cost;
  for (size_t i = 0; i < runs_.size(); ++i) run_of_cost[edge_costs_[i]] = i;
  Eigen::Index row = 0;
  for (const ceres::ResidualBlockId cost : evaluate.residual_blocks) {
    const auto run = run_of_cost.find(cost);
    const Eigen::Index size = problem_->GetCostFunctionForResidualBlock(cost)->num_residuals();
    if (run != run_of_cost.end()) {
      const MatchedRun& matched = runs_[run->second];
      const AlignedPhotograph& photograph = photographs_[matched.photograph];
      pushes.middleRows(row, size) =
          WhitenedSharedPushes(matched.samples, photograph.width_px, photograph.height_px);
    }
    row += size;
  }
  const Eigen::MatrixXd moved = solver.solve(Eigen::MatrixXd(jacobian.transpose() * pushes));

  JointRefinement joint;
  constexpr int kNumParts = kNumCameraParameters + kNumLensParameters;
  for (const MovingPhotograph& moving : moving_) {
    const int own = column_of_block.at(moving.own.data());
    const int lens = column_of_block.at(lenses_[moving.lens].data());
    Eigen::Matrix<double, kNumParts, 1> parts;
    parts << moving.own, lenses_[moving.lens];
    Eigen::MatrixXd units = Eigen::MatrixXd::Zero(num_columns, kNumParts);
    units.middleRows<kNumCameraParameters>(own).leftCols<kNumCameraParameters>().setIdentity();
    units.middleRows<kNumLensParameters>(lens).rightCols<kNumLensParameters>().setIdentity();
    const Eigen::MatrixXd columns = solver.solve(units);
    Eigen::Matrix<double, kNumParts, kNumParts> covariance;
    covariance << columns.middleRows<kNumCameraParameters>(own),
        columns.middleRows<kNumLensParameters>(lens);
    Eigen::Matrix<double, kNumParts, kNumSharedPushes> shared;
    shared << moved.middleRows<kNumCameraParameters>(own),
        moved.middleRows<kNumLensParameters>(lens);
    covariance += shared * shared.transpose();

    const auto& whole = moving.prior.whole_from_parts;
    joint.photographs.push_back({whole * parts,
                                 whole * covariance * whole.transpose(),
                                 moving.noise_px,
                                 moving.num_matched});
  }
  for (size_t number = 0; number < edges_.size(); ++number) {
    const MovingEdge& edge = edges_[number];
    const auto column = column_of_block.find(edge.displacement.data());
    if (column == column_of_block.end()) continue;
    Eigen::MatrixXd units = Eigen::MatrixXd::Zero(num_columns, 2);
    units.middleRows<2>(column->second).setIdentity();
    const Eigen::Matrix2d covariance = solver.solve(units).middleRows<2>(column->second);
    joint.displacements.push_back({static_cast<int>(number),
                                   edge.frame.Displacement(edge.displacement, -1),
                                   edge.frame.Displacement(edge.displacement, 1),
                                   edge.frame.across * covariance * edge.frame.across.transpose(),
                                   edge.num_photographs});
  }
  return joint;
}

}  // namespace

JointRefinement RefineTogether(const EdgeModel& edge_model,
                               const std::vector<AlignedPhotograph>& photographs,
                               const std::vector<int>& lenses,
                               const JointOptions& options) {
  if (photographs.empty()) return {};
  JointSolver solver(edge_model, photographs, lenses, options);
  for (int round = 0; round < options.num_rounds; ++round) {
    if (round + 1 == options.num_rounds) solver.EstimateSharedOffset();
    solver.Match(std::max(options.matching.final_range_px,
                          options.start_range_px * std::pow(options.shrink, round)));
    solver.Solve();
  }
  return solver.Result();
}

}  // namespace groundglass
