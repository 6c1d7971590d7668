// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_groups.h"

#include <cmath>
#include <map>
#include <optional>

namespace groundglass {
namespace {

// Planes that differ by less in direction are one.
constexpr double kLeastCosine = 0.9998;  // 1.1 degrees

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
    for (auto at = by_offset_.lower_bound(offset - tolerance_);
         at != by_offset_.end() && at->first <= offset + tolerance_;
         ++at) {
      if (normals_[at->second].dot(normal) > kLeastCosine) return at->second;
    }
    const int number = static_cast<int>(normals_.size());
    normals_.push_back(normal);
    by_offset_.emplace(offset, number);
    return number;
  }
  const Eigen::Vector3d& NormalOf(int number) const { return normals_[number]; }
  int Count() const { return static_cast<int>(normals_.size()); }

 private:
  Eigen::Vector3d center_;
  double tolerance_;
  std::multimap<double, int> by_offset_;
  std::vector<Eigen::Vector3d> normals_;
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

}  // namespace

EdgeGroups FindEdgeGroups(const PolygonModel& model,
                          const std::vector<ModelEdge>& edges,
                          const std::vector<bool>& on_ground,
                          double tolerance) {
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
  return groups;
}

}  // namespace groundglass
