// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edge_families.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace groundglass {
namespace {

TEST(EdgeFamilies, WallsOfOneDirectionAreAFamilyForTheirUprightsAndOneForTheRest) {
  const PolygonModel house = MakeHouse();
  const std::vector<ModelEdge> edges = FindModelEdges(house);
  const std::vector<int> families = FindEdgeFamilies(house, edges);
  ASSERT_EQ(families.size(), edges.size());
  std::map<int, std::set<bool>> uprights_of_family;
  std::map<int, std::set<int>> directions_of_family;
  for (size_t i = 0; i < edges.size(); ++i) {
    const Eigen::Vector3d along = (edges[i].end_in_world - edges[i].start_in_world).normalized();
    uprights_of_family[families[i]].insert(std::abs(along.z()) > 0.9);
    const Eigen::Vector3d normal = ComputeFacePlane(house, edges[i].first_face).normal_in_world;
    if (std::abs(normal.z()) > 0.01) continue;
    directions_of_family[families[i]].insert(
        static_cast<int>(std::lround(2 * normal.x() + normal.y())));
  }
  for (const auto& [family, uprights] : uprights_of_family)
    EXPECT_EQ(uprights.size(), 1u) << family;
  for (const auto& [family, directions] : directions_of_family) {
    EXPECT_EQ(directions.size(), 1u) << family;
  }
  EXPECT_GE(uprights_of_family.size(), 6u);
}

}  // namespace
}  // namespace groundglass
