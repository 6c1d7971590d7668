// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_groups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>

namespace groundglass {
namespace {

constexpr double kTolerance = 0.01;
constexpr double kAttached = 3;

// Axis-parallel box faces, seen from outside; from `low` to `high`.
void AddBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high, PolygonModel& model) {
  const auto first = static_cast<int>(model.points_in_world.size());
  for (int corner = 0; corner < 8; ++corner) {
    model.points_in_world.push_back({(corner & 1 ? high : low).x(),
                                     (corner & 2 ? high : low).y(),
                                     (corner & 4 ? high : low).z()});
  }
  for (const std::vector<int>& face : {std::vector{0, 1, 5, 4},
                                       {1, 3, 7, 5},
                                       {3, 2, 6, 7},
                                       {2, 0, 4, 6},
                                       {4, 5, 7, 6},
                                       {0, 2, 3, 1}}) {
    std::vector<int> points;
    for (const int point : face) points.push_back(first + point);
    model.faces.push_back({points, ""});
  }
}

EdgeGroups GroupsOf(const PolygonModel& model, const std::vector<ModelEdge>& edges) {
  return FindEdgeGroups(
      model, edges, std::vector<bool>(edges.size(), false), kTolerance, kAttached);
}

// What an edge does when the groups that move upright planes across x are moved by one.
double MoveAlongX(const std::vector<EdgeGroupPart>& parts, int group) {
  for (const EdgeGroupPart& part : parts) {
    if (part.group == group) return part.directions(0, 0);
  }
  return 0;
}

std::set<int> GroupsOfFace(const EdgeGroups& groups,
                           const std::vector<ModelEdge>& edges,
                           int face) {
  std::set<int> common;
  bool is_first = true;
  for (size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].first_face != face && edges[i].second_face != face) continue;
    std::set<int> here;
    for (const EdgeGroupPart& part : groups.of_edge[i]) {
      if (is_first || common.count(part.group) > 0) here.insert(part.group);
    }
    common = here;
    is_first = false;
  }
  return common;
}

TEST(FindEdgeGroups, AnEdgeGoesWhereBothItsPlanesGo) {
  PolygonModel model;
  AddBox({0, 0, 0}, {4, 3, 2}, model);
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const EdgeGroups groups = GroupsOf(model, edges);
  ASSERT_EQ(edges.size(), 12u);
  ASSERT_EQ(groups.num_numbers, std::vector<int>(6, 1));
  const std::set<int> east = GroupsOfFace(groups, edges, 1);
  ASSERT_EQ(east.size(), 1u);
  for (size_t i = 0; i < edges.size(); ++i) {
    ASSERT_EQ(groups.of_edge[i].size(), 2u);
    const bool is_east = edges[i].start_in_world.x() == 4 && edges[i].end_in_world.x() == 4;
    EXPECT_NEAR(MoveAlongX(groups.of_edge[i], *east.begin()), is_east ? 1 : 0, 1e-9) << i;
  }
}

TEST(FindEdgeGroups, WallsOnOneLineOfThePlanAreOneGroup) {
  PolygonModel model;
  AddBox({0, 0, 0}, {4, 3, 2}, model);
  AddBox({10, 0.001, 0}, {14, 5, 3}, model);  // its south wall on the line of the first one's
  AddBox({20, 0.1, 0}, {24, 7, 4}, model);    // beside that line
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const EdgeGroups groups = GroupsOf(model, edges);
  EXPECT_EQ(GroupsOfFace(groups, edges, 0), GroupsOfFace(groups, edges, 6));
  EXPECT_NE(GroupsOfFace(groups, edges, 0), GroupsOfFace(groups, edges, 12));
}

// A wall whose far end is a hair out of line has a normal that crosses the axis.
TEST(FindEdgeGroups, AWallIsOneGroupWhicheverWayItsPartsAreSkew) {
  PolygonModel model;
  model.points_in_world = {
      {0, 0, 0}, {10, -0.02, 0}, {20, 0, 0}, {0, 0, 5}, {10, -0.02, 5}, {20, 0, 5}};
  model.faces = {{{0, 1, 4, 3}, ""}, {{1, 2, 5, 4}, ""}};
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const EdgeGroups groups =
      FindEdgeGroups(model, edges, std::vector<bool>(edges.size(), false), 0.05, kAttached);
  EXPECT_EQ(GroupsOfFace(groups, edges, 0), GroupsOfFace(groups, edges, 1));
}

// Two walls without a roof end at one level all the same; where they stand on the ground they do
// not.
TEST(FindEdgeGroups, BordersAtOneHeightAreOneLevel) {
  PolygonModel model;
  model.points_in_world = {
      {0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, {9, 2, 0}, {9, 6, 0}, {9, 6, 3}, {9, 2, 3}};
  model.faces = {{{0, 1, 2, 3}, ""}, {{4, 5, 6, 7}, ""}};
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  std::vector<bool> on_ground;
  std::vector<size_t> tops;
  for (size_t i = 0; i < edges.size(); ++i) {
    on_ground.push_back(edges[i].start_in_world.z() == 0 && edges[i].end_in_world.z() == 0);
    if (edges[i].start_in_world.z() == 3 && edges[i].end_in_world.z() == 3) tops.push_back(i);
  }
  const EdgeGroups groups = FindEdgeGroups(model, edges, on_ground, kTolerance, kAttached);
  ASSERT_EQ(tops.size(), 2u);
  ASSERT_EQ(groups.of_edge[tops[0]].size(), 2u);
  ASSERT_EQ(groups.of_edge[tops[1]].size(), 2u);
  EXPECT_EQ(groups.of_edge[tops[0]][1].group, groups.of_edge[tops[1]][1].group);
  EXPECT_NEAR(std::abs(groups.of_edge[tops[0]][1].directions(2, 0)), 1, 1e-9);
  for (size_t i = 0; i < edges.size(); ++i) {
    EXPECT_EQ(groups.of_edge[i].size(), on_ground[i] ? 1u : 2u) << i;
  }
}

TEST(FindEdgeGroups, WhatIsDrawnOntoAPlaneMovesWithinItAsOne) {
  PolygonModel model;
  model.points_in_world = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}};
  model.faces = {{{0, 1, 2, 3}, ""}};
  ModelEdge sill{{1, 0, 1}, {2, 0, 1}, 0, 0, ModelEdge::Kind::kCoplanar, 0};
  ModelEdge jamb{{1, 0, 1}, {1, 0, 2}, 0, 0, ModelEdge::Kind::kCoplanar, 0};
  const EdgeGroups groups = GroupsOf(model, {sill, jamb});
  ASSERT_EQ(groups.num_numbers, (std::vector{1, 2}));
  for (const std::vector<EdgeGroupPart>& parts : groups.of_edge) {
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[1].group, 1);
    EXPECT_TRUE((parts[1].directions.transpose() * parts[1].directions).isIdentity(1e-9));
    EXPECT_LT((parts[1].directions.transpose() * Eigen::Vector3d::UnitY()).norm(), 1e-9);
  }
}

// Where a rounded corner's facets meet, a facet that moves by one must not send the edge far away.
TEST(FindEdgeGroups, FacetsThatAreNearlyOnePlaneMoveTheirEdgeLittle) {
  PolygonModel model;
  model.points_in_world = {
      {-4, 0.3, 0}, {0, 0, 0}, {0, 0, 3}, {-4, 0.3, 3}, {4, 0.3, 0}, {4, 0.3, 3}};
  model.faces = {{{0, 1, 2, 3}, ""}, {{1, 4, 5, 2}, ""}};
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const EdgeGroups groups = GroupsOf(model, edges);
  for (const std::vector<EdgeGroupPart>& parts : groups.of_edge) {
    for (const EdgeGroupPart& part : parts) EXPECT_LT(part.directions.norm(), 3);
  }
}

// How far an edge goes where a set goes by one; nothing if it is not of the set.
std::optional<Eigen::Vector3d> MoveOfEdgeAt(const Eigen::Vector3d& middle_in_world,
                                            const EdgeGroupSet& set,
                                            const EdgeGroups& groups,
                                            const std::vector<ModelEdge>& edges) {
  const auto moves = MovesOfSet(set, groups);
  for (size_t i = 0; i < edges.size(); ++i) {
    const Eigen::Vector3d middle = (edges[i].start_in_world + edges[i].end_in_world) / 2;
    if ((middle - middle_in_world).norm() < 1e-6) return moves[i];
  }
  ADD_FAILURE() << "no edge there";
  return std::nullopt;
}

TEST(EdgeGroupSets, WhatLiesHigherGoesWithTheEaves) {
  PolygonModel model;
  AddBox({0, 0, 0}, {10, 10, 5}, model);
  AddBox({2, 2, 5}, {4, 4, 9}, model);
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const EdgeGroups groups = GroupsOf(model, edges);
  int num_with_both = 0;
  int num_with_upper = 0;
  for (const EdgeGroupSet& set : groups.sets) {
    if (!set.across_in_world.isZero()) continue;
    const auto lower = MoveOfEdgeAt({5, 0, 5}, set, groups, edges);
    const auto upper = MoveOfEdgeAt({3, 2, 9}, set, groups, edges);
    const auto foot = MoveOfEdgeAt({5, 0, 0}, set, groups, edges);
    EXPECT_FALSE(foot) << "what all stands on is no part of the model";
    ASSERT_TRUE(upper);
    EXPECT_NEAR(upper->z(), 1, 1e-6);
    num_with_upper += !lower;
    if (!lower) continue;
    EXPECT_NEAR(lower->z(), 1, 1e-6);
    ++num_with_both;
  }
  EXPECT_GE(num_with_both, 1);
  EXPECT_EQ(num_with_upper, 1);
}

// So that it stands out as far as before, although its face is skew the other way.
TEST(EdgeGroupSets, WhatStandsOutGoesTheSameWayAsASkewWall) {
  PolygonModel model;
  AddBox({0, 0, 0}, {10, 10, 5}, model);
  AddBox({3, -1, 0}, {6, 0, 4}, model);
  for (const int point : {0, 4}) model.points_in_world[point].y() = -0.02;
  for (const int point : {9, 13}) model.points_in_world[point].y() = -1.02;
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const EdgeGroups groups = GroupsOf(model, edges);
  int num_of_wall = 0;
  for (const EdgeGroupSet& set : groups.sets) {
    if (std::abs(set.across_in_world.y()) < 0.5) continue;
    const auto wall = MoveOfEdgeAt({5, -0.01, 5}, set, groups, edges);
    const auto buttress = MoveOfEdgeAt({4.5, -1.01, 4}, set, groups, edges);
    if (!wall || !buttress) continue;
    EXPECT_GT(wall->y() * buttress->y(), 0.5);
    ++num_of_wall;
  }
  EXPECT_GE(num_of_wall, 1);
}

TEST(EdgeGroupSets, WhatStandsOutOfAWallGoesWithIt) {
  PolygonModel model;
  AddBox({0, 0, 0}, {10, 10, 5}, model);
  AddBox({-1, 4, 0}, {0, 6, 4}, model);      // a buttress of the wall at x = 0
  AddBox({-12, 20, 0}, {-7, 30, 5}, model);  // a neighbour, whose wall is 6 away
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const EdgeGroups groups = GroupsOf(model, edges);
  int num_of_wall = 0;
  for (const EdgeGroupSet& set : groups.sets) {
    if (std::abs(set.across_in_world.x()) < 0.5) continue;
    const auto wall = MoveOfEdgeAt({0, 5, 5}, set, groups, edges);
    if (!wall) continue;
    const auto buttress = MoveOfEdgeAt({-1, 5, 4}, set, groups, edges);
    const auto neighbour = MoveOfEdgeAt({-7, 25, 5}, set, groups, edges);
    EXPECT_FALSE(neighbour);
    if (!buttress) continue;
    EXPECT_LT((*buttress - *wall).norm(), 1e-6);
    ++num_of_wall;
  }
  EXPECT_GE(num_of_wall, 1);
}

}  // namespace
}  // namespace groundglass
