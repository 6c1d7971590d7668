// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/polygon_model.h"

#include <cmath>

namespace groundglass {

int FaceNumber(const PolygonModel& model, int face) {
  const int number = model.faces[face].number;
  return number > 0 ? number : face + 1;
}

Eigen::Vector3d DoubledVectorArea(const PolygonModel& model, int face) {
  const std::vector<int>& points = model.faces[face].points;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = model.points_in_world[points[0]];
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    sum += (model.points_in_world[points[i]] - origin)
               .cross(model.points_in_world[points[i + 1]] - origin);
  }
  return sum;
}

FacePlane ComputeFacePlane(const PolygonModel& model, int face) {
  const Face& polygon = model.faces[face];
  FacePlane plane;
  plane.normal_in_world = DoubledVectorArea(model, face).normalized();
  for (const int point : polygon.points) {
    plane.offset += plane.normal_in_world.dot(model.points_in_world[point]);
  }
  plane.offset /= static_cast<double>(polygon.points.size());
  return plane;
}

double ComputeFaceArea(const PolygonModel& model, int face) {
  return DoubledVectorArea(model, face).norm() / 2;
}

void ChangeUnit(LengthUnit unit, PolygonModel& model) {
  const double scale = MetresPerUnit(model.unit) / MetresPerUnit(unit);
  for (Eigen::Vector3d& point : model.points_in_world) point *= scale;
  if (model.sigma) *model.sigma *= scale;
  model.unit = unit;
}

Box ComputeBounds(const PolygonModel& model) {
  Box box;
  if (model.points_in_world.empty()) return box;
  box.min = box.max = model.points_in_world.front();
  for (const Eigen::Vector3d& point : model.points_in_world) {
    box.min = box.min.cwiseMin(point);
    box.max = box.max.cwiseMax(point);
  }
  return box;
}

std::string DescribeFace(const PolygonModel& model, int face) {
  std::string text = "face " + std::to_string(FaceNumber(model, face));
  if (!model.faces[face].name.empty()) text += " (" + model.faces[face].name + ")";
  return text;
}

}  // namespace groundglass
