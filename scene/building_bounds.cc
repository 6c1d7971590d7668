// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/building_bounds.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace groundglass {
namespace {

constexpr double kTimesLarger = 10;
// Fewer faces are no building: a drawing of a floor with a tile on it.
constexpr size_t kFewestFaces = 4;
// The cosine of the steepest that a ground as a whole is: 30 degrees.
constexpr double kFlatCosine = 0.866;

Box BoundsOfFace(const PolygonModel& model, const Face& face) {
  Box box;
  if (face.points.empty()) return box;
  box.min = box.max = model.points_in_world[face.points.front()];
  for (const int point : face.points) {
    box.min = box.min.cwiseMin(model.points_in_world[point]);
    box.max = box.max.cwiseMax(model.points_in_world[point]);
  }
  return box;
}

struct SizedFace {
  Box bounds;
  double size = 0;
  int face = -1;
};

}  // namespace

Box ComputeBuildingBounds(const PolygonModel& model) {
  std::vector<SizedFace> faces;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const Box bounds = BoundsOfFace(model, model.faces[face]);
    faces.push_back({bounds, bounds.Diagonal(), face});
  }
  if (faces.size() <= kFewestFaces) return ComputeBounds(model);
  std::stable_sort(faces.begin(), faces.end(), [](const SizedFace& a, const SizedFace& b) {
    return a.size < b.size;
  });
  // The largest number of faces that all others dwarf.
  Box box = faces.front().bounds;
  std::optional<Box> built;
  size_t num_built = 0;
  for (size_t i = 0; i + 1 < faces.size(); ++i) {
    box.min = box.min.cwiseMin(faces[i].bounds.min);
    box.max = box.max.cwiseMax(faces[i].bounds.max);
    if (i + 1 >= kFewestFaces && faces[i + 1].size > kTimesLarger * box.Diagonal()) {
      built = box;
      num_built = i + 1;
    }
  }
  if (!built) return ComputeBounds(model);
  for (size_t i = num_built; i < faces.size(); ++i) {
    const FacePlane plane = ComputeFacePlane(model, faces[i].face);
    if (std::abs(plane.normal_in_world.z()) < kFlatCosine) return ComputeBounds(model);
  }
  return *built;
}

}  // namespace groundglass
