// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/joint_state.h"

#include "scene/least_norm.h"
#include "scene/model_sigma.h"

#include <algorithm>
#include <numeric>

namespace groundglass {
namespace {

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

// For each edge those of its groups of which enough edges are seen, in units of their scale.
std::vector<std::vector<EdgeGroupPart>> GroupsOfSeenEdges(
    const EdgeModel& edge_model,
    const std::vector<AlignedPhotograph>& photographs,
    const JointOptions& options) {
  const EdgeGroups& groups = edge_model.groups;
  std::vector<bool> is_seen(edge_model.edges.size(), false);
  for (const AlignedPhotograph& photograph : photographs) {
    for (const CandidateSample& found : photograph.found) is_seen[found.sample.edge] = true;
  }
  std::vector<int> num_seen(groups.num_numbers.size(), 0);
  for (size_t edge = 0; edge < is_seen.size(); ++edge) {
    if (!is_seen[edge]) continue;
    for (const EdgeGroupPart& part : groups.of_edge[edge]) ++num_seen[part.group];
  }
  std::vector<int> by_count(num_seen.size());
  std::iota(by_count.begin(), by_count.end(), 0);
  std::stable_sort(
      by_count.begin(), by_count.end(), [&](int a, int b) { return num_seen[a] > num_seen[b]; });
  std::vector<bool> is_moved(num_seen.size(), false);
  for (size_t i = 0; i < by_count.size() && i < static_cast<size_t>(options.most_groups); ++i) {
    is_moved[by_count[i]] = num_seen[by_count[i]] >= options.least_edges_of_group;
  }
  // What lies elsewhere than it is drawn stays there, however little is seen of it.
  for (size_t group = 0; group < edge_model.group_offsets.size(); ++group) {
    if (!edge_model.group_offsets[group].isZero()) is_moved[group] = true;
  }
  std::vector<std::vector<EdgeGroupPart>> moved(is_seen.size());
  for (size_t edge = 0; edge < is_seen.size(); ++edge) {
    for (EdgeGroupPart part : groups.of_edge[edge]) {
      if (!is_moved[part.group]) continue;
      part.directions *= options.group_offset_sigmas * edge_model.sigma;
      moved[edge].push_back(part);
    }
  }
  return moved;
}

// Bytes that hold both arrays, whatever lies between them for alignment.
size_t SizeOfMovers(size_t num_edges, size_t num_ties) {
  return num_edges * sizeof(MovingEdge) + num_ties * sizeof(MovingTie) + 256;
}

// Each lens starts at the mean of what its photographs found by themselves.
std::vector<LensParameters> StartLenses(const JointState& state) {
  int num_lenses = 0;
  for (const MovingPhotograph& moving : state.moving)
    num_lenses = std::max(num_lenses, moving.lens + 1);
  std::vector<LensParameters> lenses(num_lenses, LensParameters::Zero());
  std::vector<int> counts(num_lenses, 0);
  for (size_t p = 0; p < state.moving.size(); ++p) {
    const CameraParameters change = state.photographs[p].prior.root * state.photographs[p].whitened;
    const auto& lens_root = state.moving[p].prior.lens_root;
    lenses[state.moving[p].lens] += SolveLeastNorm(lens_root, change);
    ++counts[state.moving[p].lens];
  }
  for (int i = 0; i < num_lenses; ++i) lenses[i] /= std::max(1, counts[i]);
  return lenses;
}

}  // namespace

JointState::JointState(const EdgeModel& edge_model_,
                       const std::vector<AlignedPhotograph>& photographs_,
                       const std::vector<int>& lens_of_photograph,
                       const std::vector<TiePoint>& tie_points_,
                       const JointOptions& options)
    : edge_model(edge_model_),
      photographs(photographs_),
      tie_points(tie_points_),
      arena(SizeOfMovers(edge_model_.edges.size(), tie_points_.size())),
      own_bias(options.own),
      edges(edge_model_.edges.size(), &arena),
      ties(&arena) {
  ties.reserve(tie_points.size());
  for (const TiePoint& point : tie_points) {
    ties.push_back({FrameOfTiePoint(point, edge_model.sigma), Eigen::Vector3d::Zero()});
  }
  for (const int num_numbers : edge_model.groups.num_numbers) {
    groups.push_back({Eigen::Vector2d::Zero(), num_numbers});
  }
  group_offset_sigmas = options.group_offset_sigmas;
  for (size_t i = 0; i < edge_model.group_offsets.size(); ++i) {
    groups[i].move = edge_model.group_offsets[i] / (group_offset_sigmas * edge_model.sigma);
  }
  groups_of_edge = GroupsOfSeenEdges(edge_model, photographs, options);
  ground.frame = FrameOfGround(edge_model.model, options);
  const LensParameters own_shares{{options.own_view_angle_share,
                                   options.own_aspect_share,
                                   options.own_shift_share,
                                   options.own_shift_share,
                                   options.own_k1_share}};
  for (size_t p = 0; p < photographs.size(); ++p) {
    const AlignedPhotograph& photograph = photographs[p];
    moving.push_back({SplitIntoOwnAndLens(photograph.prior, own_shares),
                      photograph.whitened,
                      lens_of_photograph[p],
                      photograph.noise_px,
                      0});
    for (const CandidateSample& found : photograph.found) {
      const int edge = found.sample.edge;
      edges[edge].frame = FrameOfEdge(edge_model.sigma, edge_model.edges[edge], options);
    }
  }
  lenses = StartLenses(*this);
}

Eigen::Vector3d JointState::GroupMoveOf(int edge) const {
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  for (const EdgeGroupPart& part : groups_of_edge[edge]) {
    move += part.directions * groups[part.group].move.head(part.directions.cols());
  }
  return move;
}

Eigen::Vector3d JointState::DisplacementOf(int edge, double along) const {
  const MovingEdge& mover = MoverOf(edge);
  return GroupMoveOf(edge) + mover.frame.Displacement(mover.displacement, along);
}

}  // namespace groundglass
