// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/joint_refinement.h"

#include "register/camera/standard_normal_cost.h"
#include "register/edges/edge_clusters.h"
#include "register/edges/weighted_median.h"
#include "register/joint/image_edge_error.h"
#include "register/joint/normal_equations.h"
#include "register/joint/shared_edge_cost.h"
#include "register/refine/systematic_error.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/least_norm.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <ceres/ceres.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// A model edge as the solve moves it.
struct MovingEdge {
  EdgeFrame frame;
  Eigen::Vector4d displacement = Eigen::Vector4d::Zero();  // in units of the frame's scale
  int num_photographs = 0;                                 // that matched it in the last round
  std::vector<ceres::ResidualBlockId> prior_costs;
};

// A photograph as the solve moves it.
struct MovingPhotograph {
  SplitPrior prior;
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

EdgeFrame FrameOfEdge(double model_sigma, const ModelEdge& edge, const JointOptions& options) {
  const double scale_units = options.common_offset_sigmas * model_sigma;
  const Eigen::Vector3d direction = (edge.end_in_world - edge.start_in_world).normalized();
  const Eigen::Vector3d first = direction.unitOrthogonal();
  EdgeFrame frame;
  frame.across.col(0) = scale_units * first;
  frame.across.col(1) = scale_units * direction.cross(first);
  frame.turn_ratio = options.common_turn_sigmas / options.common_offset_sigmas;
  return frame;
}

// All edges on the ground as one: soil and plants hide the foot of every wall alike.
EdgeFrame FrameOfGround(const PolygonModel& model, const JointOptions& options) {
  EdgeFrame frame;
  frame.across(2, 0) =
      options.ground_level_sigmas * std::max(ModelSigma(model), DefaultModelSigma(model));
  frame.turn_ratio = 0;
  return frame;
}

class JointSolver {
 public:
  JointSolver(const EdgeModel& edge_model,
              const std::vector<AlignedPhotograph>& photographs,
              const std::vector<int>& lenses,
              const JointOptions& options)
      : edge_model_(edge_model),
        photographs_(photographs),
        options_(options),
        own_bias_(options.own),
        edges_(edge_model.edges.size()) {
    ground_.frame = FrameOfGround(edge_model.model, options);
    const LensParameters own_shares(
        options.own_view_angle_share, options.own_aspect_share, options.own_k1_share);
    for (size_t p = 0; p < photographs.size(); ++p) {
      const AlignedPhotograph& photograph = photographs[p];
      moving_.push_back({SplitIntoOwnAndLens(photograph.prior, own_shares),
                         photograph.whitened,
                         lenses[p],
                         photograph.noise_px,
                         0});
      for (const CandidateSample& found : photograph.found) {
        const int edge = found.sample.edge;
        edges_[edge].frame = FrameOfEdge(edge_model.sigma, edge_model.edges[edge], options);
      }
    }
    StartLenses();
  }

  // Chooses candidates anew about the present solution, within a range that is so much smaller than
  // the first (1: the first).
  void Match(double shrink) {
    runs_.clear();
    for (MovingEdge& edge : edges_) edge.num_photographs = 0;
    own_size_sum_ = 0;
    for (size_t p = 0; p < photographs_.size(); ++p) MatchPhotograph(p, shrink);
    if (!runs_.empty()) {
      own_bias_.edge_offset_sigmas =
          std::clamp(own_bias_.edge_offset_sigmas *
                         std::sqrt(own_size_sum_ / static_cast<double>(runs_.size())),
                     options_.least_own_offset_sigmas,
                     options_.most_own_offset_sigmas);
      own_bias_.edge_turn_sigmas = own_bias_.edge_offset_sigmas;
    }
  }

  // Moves everything, candidates held. Leaves the problem for Result.
  void Solve() {
    problem_ = std::make_unique<ceres::Problem>();
    edge_costs_.clear();
    for (MovingEdge& edge : edges_) edge.prior_costs.clear();
    for (const MatchedRun& run : runs_) {
      MovingPhotograph& moving = moving_[run.photograph];
      MovingEdge& edge = MoverOf(run.edge);
      edge_costs_.push_back(
          problem_->AddResidualBlock(new SharedEdgeCost(run.samples, moving.prior, edge.frame),
                                     nullptr,
                                     moving.own.data(),
                                     lenses_[moving.lens].data(),
                                     edge.displacement.data()));
    }
    // Ceres orders the blocks of a group by their addresses: each group is one array, so that the
    // order, and with it the rounding, is the same in every run.
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    if (problem_->HasParameterBlock(ground_.displacement.data())) {
      problem_->AddResidualBlock(new StandardNormalCost<4>, nullptr, ground_.displacement.data());
      ordering->AddElementToGroup(ground_.displacement.data(), 1);
    }
    for (MovingEdge& edge : edges_) {
      double* block = edge.displacement.data();
      if (!problem_->HasParameterBlock(block)) continue;
      // Tails end somewhere: no building is off by a room.
      const double widest = options_.widest_offset_sigmas / options_.common_offset_sigmas;
      edge.prior_costs = {
          problem_->AddResidualBlock(new StandardNormalCost<4>, new ceres::CauchyLoss(1), block),
          problem_->AddResidualBlock(
              new StandardNormalCost<4>,
              new ceres::ScaledLoss(nullptr, 1 / (widest * widest), ceres::TAKE_OWNERSHIP),
              block)};
      ordering->AddElementToGroup(block, 0);
    }
    for (MovingPhotograph& moving : moving_) {
      problem_->AddResidualBlock(
          new StandardNormalCost<kNumCameraParameters>, nullptr, moving.own.data());
      ordering->AddElementToGroup(moving.own.data(), 2);
    }
    for (LensParameters& lens : lenses_) {
      problem_->AddResidualBlock(new StandardNormalCost<kNumLensParameters>, nullptr, lens.data());
      ordering->AddElementToGroup(lens.data(), 3);
    }
    ceres::Solver::Options solver;
    solver.linear_solver_ordering = ordering;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.max_num_iterations = 6;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, problem_.get(), &summary);
    if (!summary.IsSolutionUsable()) {
      throw Error("register: the photographs' common solution was not found: " +
                  OneLine(summary.message));
    }
  }

  // Where edges were found farther from the model, more may also be hidden that moves all edges
  // together: takes its size from them.
  void EstimateSharedOffset();

  JointRefinement Result();

 private:
  void StartLenses();
  void MatchPhotograph(size_t p, double shrink);
  double RangeOf(const CandidateSample& found, double shrink) const;
  // What moves an edge: its own displacement, or the ground's.
  MovingEdge& MoverOf(int edge) {
    return edge_model_.tolerances[edge].on_ground ? ground_ : edges_[edge];
  }
  std::vector<double*> Blocks();
  std::optional<ResidualSpread> SpreadOf(size_t p) const;
  Eigen::MatrixXd SharedPushes(const NormalEquations& equations) const;
  Eigen::MatrixXd LeaveOutUpdates(const NormalEquations& equations) const;

  const EdgeModel& edge_model_;
  const std::vector<AlignedPhotograph>& photographs_;
  const JointOptions& options_;
  EdgeBias own_bias_;
  double own_size_sum_ = 0;  // over the runs of the last matching, in units of own_bias_
  std::vector<MovingPhotograph> moving_;
  std::vector<LensParameters> lenses_;
  std::vector<MovingEdge> edges_;  // for each of EdgeModel::edges
  MovingEdge ground_;
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
    lenses_[moving_[p].lens] += SolveLeastNorm(lens_root, change);
    ++counts[moving_[p].lens];
  }
  for (int i = 0; i < num_lenses; ++i) lenses_[i] /= std::max(1, counts[i]);
}

void JointSolver::MatchPhotograph(size_t p, double shrink) {
  const AlignedPhotograph& photograph = photographs_[p];
  MovingPhotograph& moving = moving_[p];
  const ParameterProjection projection =
      moving.prior.ProjectionAt(moving.own, lenses_[moving.lens]);
  std::vector<WeightedValue> residuals;
  std::vector<double> run_residuals_px;
  moving.num_matched = 0;
  const std::vector<CandidateSample>& found = photograph.found;
  for (size_t start = 0; start < found.size();) {
    MatchedRun run{p, found[start].sample.edge, {}};
    const MovingEdge& mover = MoverOf(run.edge);
    run_residuals_px.clear();
    size_t end = start;
    for (; end < found.size() && found[end].sample.edge == run.edge; ++end) {
      const CandidateSample& sample = found[end];
      const auto projected =
          projection.Project(sample.sample.point_in_world +
                             mover.frame.Displacement(mover.displacement, sample.sample.along));
      if (!projected) continue;
      const double predicted_px = sample.normal.dot(projected->image_px - sample.origin_px);
      const double range_px = RangeOf(sample, shrink);
      const SoftAssignment match =
          MatchCandidates(sample, predicted_px, range_px, moving.noise_px, options_.matching);
      if (!(match.precision > 0)) continue;
      run.samples.push_back(MakeAlignedSample(sample, match, edge_model_.sigma, own_bias_));
      run_residuals_px.push_back(match.offset_px - predicted_px);
      residuals.push_back({std::abs(match.offset_px - predicted_px), match.precision});
    }
    start = end;
    if (run.samples.empty()) continue;
    const ImageEdgeError own =
        EstimateImageEdgeError(run.samples, run_residuals_px, options_.own_degrees_of_freedom);
    for (AlignedSample& sample : run.samples) sample.bias_px *= own.widening;
    own_size_sum_ += own.size;
    moving.num_matched += static_cast<int>(run.samples.size());
    ++edges_[run.edge].num_photographs;
    runs_.push_back(std::move(run));
  }
  moving.noise_px = std::clamp(1.4826 * WeightedMedian(std::move(residuals), 1),
                               options_.min_noise_px,
                               options_.matching.final_range_px / 2);
}

// How far to both sides of where a sample is predicted its edge is taken: at first all of a loose
// model's error, at the end what single photographs see of it.
double JointSolver::RangeOf(const CandidateSample& found, double shrink) const {
  const double loose_px = found.sample.looseness * found.px_per_unit;
  const double final_px =
      std::hypot(options_.matching.final_range_px, 3 * options_.own.edge_offset_sigmas * loose_px);
  return std::max(final_px, shrink * std::hypot(options_.start_range_px, 3 * loose_px));
}

void JointSolver::EstimateSharedOffset() {
  std::vector<double> offsets_sigmas;
  for (size_t number = 0; number < edges_.size(); ++number) {
    const MovingEdge& edge = edges_[number];
    // The ground has a level of its own; its edges' displacements stay zero and say nothing.
    if (edge.num_photographs < 2 || edge_model_.tolerances[number].on_ground) continue;
    offsets_sigmas.push_back(edge.frame.Displacement(edge.displacement, 0).norm() /
                             edge_model_.sigma);
  }
  if (offsets_sigmas.empty()) return;
  const auto quartile =
      offsets_sigmas.begin() + static_cast<std::ptrdiff_t>(offsets_sigmas.size() * 3 / 4);
  std::nth_element(offsets_sigmas.begin(), quartile, offsets_sigmas.end());
  own_bias_.shared_offset_sigmas = std::clamp(
      *quartile, options_.least_shared_offset_sigmas, options_.most_shared_offset_sigmas);
}

std::vector<double*> JointSolver::Blocks() {
  std::vector<double*> blocks;
  const auto add_edge = [&](MovingEdge& edge) {
    if (problem_->HasParameterBlock(edge.displacement.data())) {
      blocks.push_back(edge.displacement.data());
    }
  };
  for (MovingEdge& edge : edges_) add_edge(edge);
  add_edge(ground_);
  for (MovingPhotograph& moving : moving_) blocks.push_back(moving.own.data());
  for (LensParameters& lens : lenses_) blocks.push_back(lens.data());
  return blocks;
}

// What all edges may lie off together (WhitenedSystematicModes).
Eigen::MatrixXd JointSolver::SharedPushes(const NormalEquations& equations) const {
  Eigen::MatrixXd pushes = Eigen::MatrixXd::Zero(equations.Residuals().size(), kNumSystematicModes);
  for (size_t i = 0; i < runs_.size(); ++i) {
    const auto [first, size] = equations.RowsOfCosts().at(edge_costs_[i]);
    const CameraPrior& prior = photographs_[runs_[i].photograph].prior;
    pushes.middleRows(first, size) =
        WhitenedSystematicModes(runs_[i].samples, prior.width_px, prior.height_px);
  }
  return pushes;
}

// Where edges of a cluster err together, what is left of them does not average out: how far the
// solution would move without each cluster in each photograph (the jackknife by clusters, CR3: Bell
// and McCaffrey, Survey Methodology 2002). What is left alone is too little where a cluster decides
// much: the camera has followed it.
Eigen::MatrixXd JointSolver::LeaveOutUpdates(const NormalEquations& equations) const {
  const std::vector<int> clusters = FindEdgeClusters(edge_model_.model, edge_model_.edges);
  std::map<std::pair<size_t, int>, std::vector<NormalEquations::Rows>> rows_of_cluster;
  for (size_t i = 0; i < runs_.size(); ++i) {
    rows_of_cluster[{runs_[i].photograph, clusters[runs_[i].edge]}].push_back(
        equations.RowsOfCosts().at(edge_costs_[i]));
  }
  std::vector<const std::vector<NormalEquations::Rows>*> left_out;
  for (const auto& [cluster, rows] : rows_of_cluster) left_out.push_back(&rows);
  Eigen::MatrixXd moves(equations.NumColumns(), static_cast<Eigen::Index>(left_out.size()));
  tbb::parallel_for(size_t{0}, left_out.size(), [&](size_t i) {
    moves.col(static_cast<Eigen::Index>(i)) = equations.LeaveOutUpdate(*left_out[i]);
  });
  return moves;
}

// How a photograph's matched samples scatter about the model's edges as the model has them.
std::optional<ResidualSpread> JointSolver::SpreadOf(size_t p) const {
  const MovingPhotograph& moving = moving_[p];
  const ParameterProjection projection =
      moving.prior.ProjectionAt(moving.own, lenses_[moving.lens]);
  std::vector<WeightedValue> residuals;
  for (const MatchedRun& run : runs_) {
    if (run.photograph != p) continue;
    for (const AlignedSample& sample : run.samples) {
      const auto projected = projection.Project(sample.point_in_world);
      if (!projected) continue;
      residuals.push_back(
          {sample.normal.dot(projected->image_px - sample.origin_px) - sample.offset_px,
           sample.precision});
    }
  }
  if (residuals.empty()) return std::nullopt;
  return MeasureSpread(std::move(residuals));
}

JointRefinement JointSolver::Result() {
  const NormalEquations equations(*problem_, Blocks());
  const Eigen::MatrixXd by_shared = equations.LinearResponse(SharedPushes(equations).sparseView());
  const Eigen::MatrixXd by_cluster = LeaveOutUpdates(equations);

  JointRefinement joint;
  constexpr int kNumParts = kNumCameraParameters + kNumLensParameters;
  for (const MovingPhotograph& moving : moving_) {
    const Eigen::Index own = equations.ColumnOf(moving.own.data());
    const Eigen::Index lens = equations.ColumnOf(lenses_[moving.lens].data());
    // Of sizes known at run time only: products of each fixed size take the compiler seconds.
    Eigen::VectorXd parts(kNumParts);
    parts << moving.own, lenses_[moving.lens];
    const auto rows_of_parts = [&](const Eigen::MatrixXd& columns) {
      Eigen::MatrixXd rows(kNumParts, columns.cols());
      rows << columns.middleRows<kNumCameraParameters>(own),
          columns.middleRows<kNumLensParameters>(lens);
      return rows;
    };
    Eigen::MatrixXd covariance(kNumParts, kNumParts);
    covariance << rows_of_parts(equations.CovarianceColumns(own, kNumCameraParameters)),
        rows_of_parts(equations.CovarianceColumns(lens, kNumLensParameters));
    const Eigen::MatrixXd shared = rows_of_parts(by_shared);
    const Eigen::MatrixXd cluster = rows_of_parts(by_cluster);
    covariance += shared * shared.transpose() + cluster * cluster.transpose();

    const Eigen::MatrixXd whole = moving.prior.whole_from_parts;
    joint.photographs.push_back({whole * parts,
                                 whole * covariance * whole.transpose(),
                                 moving.num_matched,
                                 SpreadOf(joint.photographs.size())});
  }
  for (size_t number = 0; number < edges_.size(); ++number) {
    if (edges_[number].num_photographs == 0) continue;
    const MovingEdge& mover = MoverOf(static_cast<int>(number));
    const Eigen::Index column = equations.ColumnOf(mover.displacement.data());
    const Eigen::Matrix2d covariance = equations.CovarianceColumns(column, 2).middleRows<2>(column);
    joint.displacements.push_back({static_cast<int>(number),
                                   mover.frame.Displacement(mover.displacement, -1),
                                   mover.frame.Displacement(mover.displacement, 1),
                                   mover.frame.across * covariance * mover.frame.across.transpose(),
                                   edges_[number].num_photographs});
  }
  return joint;
}

}  // namespace

void JointOptions::Check(const std::string& path) const {
  CheckAbove(common_offset_sigmas, 0, path + "common_offset_sigmas");
  CheckAbove(common_turn_sigmas, 0, path + "common_turn_sigmas");
  CheckAbove(widest_offset_sigmas, 0, path + "widest_offset_sigmas");
  CheckAbove(ground_level_sigmas, 0, path + "ground_level_sigmas");
  own.Check(path + "own.");
  CheckAbove(own_degrees_of_freedom, 0, path + "own_degrees_of_freedom");
  CheckAbove(least_own_offset_sigmas, 0, path + "least_own_offset_sigmas");
  CheckAtLeast(most_own_offset_sigmas, least_own_offset_sigmas, path + "most_own_offset_sigmas");
  CheckAbove(least_shared_offset_sigmas, 0, path + "least_shared_offset_sigmas");
  CheckAtLeast(
      most_shared_offset_sigmas, least_shared_offset_sigmas, path + "most_shared_offset_sigmas");
  CheckFromTo(own_k1_share, 1e-9, 1, path + "own_k1_share");
  CheckFromTo(own_view_angle_share, 1e-9, 1, path + "own_view_angle_share");
  CheckFromTo(own_aspect_share, 1e-9, 1, path + "own_aspect_share");
  CheckFromTo(num_rounds, 1, 1000, path + "num_rounds");
  matching.Check(path + "matching.");
  CheckAtLeast(spare_range, 1, path + "spare_range");
  CheckAtLeast(start_range_px, matching.final_range_px, path + "start_range_px");
  CheckFromTo(shrink, 0.01, 0.99, path + "shrink");
  CheckFromTo(min_noise_px, 1e-6, matching.final_range_px / 2, path + "min_noise_px");
}

JointRefinement RefineTogether(const EdgeModel& edge_model,
                               const std::vector<AlignedPhotograph>& photographs,
                               const std::vector<int>& lenses,
                               const JointOptions& options) {
  if (photographs.empty()) return {};
  JointSolver solver(edge_model, photographs, lenses, options);
  for (int round = 0; round < options.num_rounds; ++round) {
    if (round + 1 == options.num_rounds) solver.EstimateSharedOffset();
    solver.Match(std::pow(options.shrink, round));
    solver.Solve();
  }
  return solver.Result();
}

}  // namespace groundglass
