// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_clusters.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace groundglass {
namespace {

TEST(EdgeFamilies, WallsOfOneDirectionAreAFamilyForTheirUprightsAndOneForTheRest) {
  const PolygonModel house = MakeHouse();
  const std::vector<ModelEdge> edges = FindModelEdges(house);
  const std::vector<int> clusters = FindEdgeClusters(house, edges);
  ASSERT_EQ(clusters.size(), edges.size());
  std::map<int, std::set<bool>> uprights_of_cluster;
  std::map<int, std::set<int>> directions_of_cluster;
  for (size_t i = 0; i < edges.size(); ++i) {
    const Eigen::Vector3d along = (edges[i].end_in_world - edges[i].start_in_world).normalized();
    uprights_of_cluster[clusters[i]].insert(std::abs(along.z()) > 0.9);
    const Eigen::Vector3d normal = ComputeFacePlane(house, edges[i].first_face).normal_in_world;
    if (std::abs(normal.z()) > 0.01) continue;
    directions_of_cluster[clusters[i]].insert(
        static_cast<int>(std::lround(2 * normal.x() + normal.y())));
  }
  for (const auto& [cluster, uprights] : uprights_of_cluster)
    EXPECT_EQ(uprights.size(), 1u) << cluster;
  for (const auto& [cluster, directions] : directions_of_cluster) {
    EXPECT_EQ(directions.size(), 1u) << cluster;
  }
  EXPECT_GE(uprights_of_cluster.size(), 6u);
}

}  // namespace
}  // namespace groundglass
