// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/double_faces.h"

#include "scene/outline_sides.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace groundglass {
namespace {

// The face's borders between welded points, whichever way they run, in order.
std::vector<std::pair<int, int>> SortedBorders(const PolygonModel& model,
                                               int face,
                                               const std::vector<int>& weld) {
  const std::vector<int>& points = model.faces[face].points;
  std::vector<std::pair<int, int>> borders;
  for (const OutlineSide& side : FindBorders(model, face)) {
    borders.push_back(std::minmax(weld[points[side.start]], weld[points[side.end]]));
  }
  std::sort(borders.begin(), borders.end());
  return borders;
}

}  // namespace

std::vector<int> FindDoubleFaces(const PolygonModel& model, const std::vector<int>& faces) {
  const std::vector<int> weld = WeldCorners(model.points_in_world);
  std::vector<std::pair<uint64_t, int>> hashes;
  for (const int face : faces) {
    uint64_t hash = 1469598103934665603u;
    for (const auto& [first, second] : SortedBorders(model, face, weld)) {
      for (const int number : {first, second}) {
        hash = (hash ^ static_cast<uint64_t>(number)) * 1099511628211u;
      }
    }
    hashes.emplace_back(hash, face);
  }
  std::sort(hashes.begin(), hashes.end());
  std::vector<int> first_of(model.faces.size(), -1);
  std::vector<int> alike;  // faces with this hash that are no doubles
  for (size_t i = 0; i < hashes.size(); ++i) {
    const auto& [hash, face] = hashes[i];
    if (i > 0 && hashes[i - 1].first != hash) alike.clear();
    for (const int other : alike) {
      if (SortedBorders(model, other, weld) == SortedBorders(model, face, weld)) {
        first_of[face] = other;
      }
    }
    if (first_of[face] < 0) alike.push_back(face);
  }
  return first_of;
}

}  // namespace groundglass
