// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_groups.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace groundglass {
namespace {

// Planes by their numbers, each as often as it is asked for the same.
class PlaneNumbers {
 public:
  PlaneNumbers(const Eigen::Vector3d& center, double tolerance)
      : center_(center), tolerance_(tolerance) {}

  // normal: unit length, of either sign. The plane is the first one found that is near enough.
  int NumberOf(Eigen::Vector3d normal, const Eigen::Vector3d& point_in_world) {
    constexpr double kNothing = 1e-3;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(normal[axis]) < kNothing) continue;
      if (normal[axis] < 0) normal = -normal;
      break;
    }
    const double offset = normal.dot(point_in_world - center_);
    // Of two planes that are nearly one, either may have its normal turned round.
    for (const double sign : {1.0, -1.0}) {
      for (auto at = by_offset_.lower_bound(sign * offset - tolerance_);
           at != by_offset_.end() && at->first <= sign * offset + tolerance_;
           ++at) {
        if (sign * normals_[at->second].dot(normal) > kParallelCosine) return at->second;
      }
    }
    const int number = static_cast<int>(normals_.size());
    normals_.push_back(normal);
    offsets_.push_back(offset);
    by_offset_.emplace(offset, number);
    return number;
  }
  const Eigen::Vector3d& NormalOf(int number) const { return normals_[number]; }
  double OffsetOf(int number) const { return offsets_[number]; }
  int Count() const { return static_cast<int>(normals_.size()); }

 private:
  Eigen::Vector3d center_;
  double tolerance_;
  std::multimap<double, int> by_offset_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> offsets_;
};

// Where the line that two planes share goes when each moves by one along its normal. For planes
// that are nearly one, where it would go far, less.
Eigen::Matrix<double, 3, 2> MovesOfIntersection(const Eigen::Vector3d& first,
                                                const Eigen::Vector3d& second) {
  constexpr double kDamping = 0.05;
  Eigen::Matrix<double, 3, 2> normals;
  normals << first, second;
  const Eigen::Matrix2d products =
      normals.transpose() * normals + kDamping * Eigen::Matrix2d::Identity();
  return (1 + kDamping) * normals * products.inverse();
}

EdgeGroupPart PlanePart(int group, const Eigen::Vector3d& direction) {
  EdgeGroupPart part;
  part.group = group;
  part.directions = direction;
  return part;
}

// How high the lowest point of each group's edges lies.
std::vector<double> LowestHeights(const std::vector<ModelEdge>& edges,
                                  const std::vector<std::vector<EdgeGroupPart>>& parts_of_edge,
                                  int num_groups) {
  std::vector<double> lowest(num_groups, std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < edges.size(); ++i) {
    const double height = std::min(edges[i].start_in_world.z(), edges[i].end_in_world.z());
    for (const EdgeGroupPart& part : parts_of_edge[i]) {
      lowest[part.group] = std::min(lowest[part.group], height);
    }
  }
  return lowest;
}

// For each plane those that go where it goes: with an upright one those that are parallel and near;
// with eaves and roofs, which go up and down, all of them that lie no lower. Nothing goes with what
// all stands on: that is the cameras' height, and no part of the model.
std::vector<EdgeGroupSet> FindSets(const PlaneNumbers& planes,
                                   const std::vector<double>& lowest,
                                   double tolerance,
                                   double attached) {
  constexpr double kLeastSlope = 0.05;  // the upright part of a plane's normal
  // Each plane is compared with each, and a set may hold them all: towns are not asked.
  constexpr int kMostPlanes = 2000;
  if (planes.Count() > kMostPlanes) return {};
  std::vector<EdgeGroupSet> sets;
  std::set<std::vector<int>> known;
  const double ground = lowest.empty() ? 0 : *std::min_element(lowest.begin(), lowest.end());
  for (int plane = 0; plane < planes.Count(); ++plane) {
    const Eigen::Vector3d& normal = planes.NormalOf(plane);
    const bool is_upright = std::abs(normal.z()) < kLeastSlope;
    if (!is_upright && lowest[plane] <= ground + tolerance) continue;
    EdgeGroupSet set;
    if (is_upright) set.across_in_world = normal;
    for (int other = 0; other < planes.Count(); ++other) {
      const Eigen::Vector3d& other_normal = planes.NormalOf(other);
      const double sign = normal.dot(other_normal) < 0 ? -1 : 1;
      const bool goes_along =
          is_upright
              ? sign * normal.dot(other_normal) > kParallelCosine &&
                    std::abs(sign * planes.OffsetOf(other) - planes.OffsetOf(plane)) <= attached
              : lowest[other] >= lowest[plane] - tolerance &&
                    std::abs(other_normal.z()) >= kLeastSlope;
      if (!goes_along) continue;
      set.groups.push_back(other);
      set.factors.push_back(is_upright ? sign : other_normal.z());
    }
    if (known.insert(set.groups).second) sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace

EdgeGroups FindEdgeGroups(const PolygonModel& model,
                          const std::vector<ModelEdge>& edges,
                          const std::vector<bool>& on_ground,
                          double tolerance,
                          double attached) {
  PlaneNumbers planes(ComputeBounds(model).Center(), tolerance);
  std::vector<std::optional<int>> plane_of_face(model.faces.size());
  const auto plane_of = [&](int face, const Eigen::Vector3d& point_in_world) {
    if (!plane_of_face[face]) {
      const FacePlane plane = ComputeFacePlane(model, face);
      plane_of_face[face] = planes.NumberOf(plane.normal_in_world, point_in_world);
    }
    return *plane_of_face[face];
  };

  EdgeGroups groups;
  groups.of_edge.resize(edges.size());
  std::vector<int> drawn_on(edges.size(), -1);  // the plane that a line is drawn onto
  for (size_t i = 0; i < edges.size(); ++i) {
    const ModelEdge& edge = edges[i];
    const Eigen::Vector3d middle = (edge.start_in_world + edge.end_in_world) / 2;
    const int first = plane_of(edge.first_face, middle);
    std::vector<EdgeGroupPart>& parts = groups.of_edge[i];
    int second = edge.second_face >= 0 ? plane_of(edge.second_face, middle) : -1;
    if (edge.kind == ModelEdge::Kind::kCoplanar || second == first) {
      parts.push_back(PlanePart(first, planes.NormalOf(first)));
      if (edge.kind == ModelEdge::Kind::kCoplanar) drawn_on[i] = first;
      continue;
    }
    if (second < 0 && on_ground[i]) {
      parts.push_back(PlanePart(first, planes.NormalOf(first)));
      continue;
    }
    if (second < 0) {
      const Eigen::Vector3d along = (edge.end_in_world - edge.start_in_world).normalized();
      const Eigen::Vector3d across = along.cross(planes.NormalOf(first)).normalized();
      second = planes.NumberOf(across, middle);
    }
    const Eigen::Matrix<double, 3, 2> moves =
        MovesOfIntersection(planes.NormalOf(first), planes.NormalOf(second));
    parts.push_back(PlanePart(first, moves.col(0)));
    parts.push_back(PlanePart(second, moves.col(1)));
  }
  groups.num_numbers.assign(planes.Count(), 1);

  std::map<int, int> drawing_of_plane;
  for (size_t i = 0; i < edges.size(); ++i) {
    if (drawn_on[i] < 0) continue;
    const auto [at, is_new] =
        drawing_of_plane.emplace(drawn_on[i], static_cast<int>(groups.num_numbers.size()));
    if (is_new) groups.num_numbers.push_back(2);
    const Eigen::Vector3d& normal = planes.NormalOf(drawn_on[i]);
    EdgeGroupPart part;
    part.group = at->second;
    part.directions.resize(3, 2);
    part.directions.col(0) = normal.unitOrthogonal();
    part.directions.col(1) = normal.cross(part.directions.col(0));
    groups.of_edge[i].push_back(part);
  }
  groups.sets =
      FindSets(planes,
               LowestHeights(edges, groups.of_edge, static_cast<int>(groups.num_numbers.size())),
               tolerance,
               attached);
  for (const auto& [plane, group] : drawing_of_plane) {
    for (int number = 0; number < 2; ++number)
      groups.sets.push_back({{group}, {1}, number, Eigen::Vector3d::Zero()});
  }
  return groups;
}

std::vector<std::optional<Eigen::Vector3d>> MovesOfSet(const EdgeGroupSet& set,
                                                       const EdgeGroups& groups) {
  std::vector<double> factor_of_group(groups.num_numbers.size(), 0);
  for (size_t i = 0; i < set.groups.size(); ++i) factor_of_group[set.groups[i]] = set.factors[i];
  std::vector<std::optional<Eigen::Vector3d>> moves(groups.of_edge.size());
  for (size_t edge = 0; edge < moves.size(); ++edge) {
    for (const EdgeGroupPart& part : groups.of_edge[edge]) {
      const double factor = factor_of_group[part.group];
      if (factor == 0) continue;
      if (!moves[edge]) moves[edge] = Eigen::Vector3d::Zero();
      *moves[edge] += factor * part.directions.col(set.number);
    }
  }
  return moves;
}

}  // namespace groundglass
