// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/model_errors.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace groundglass {
namespace {

const std::vector<std::string> kNames = {"s1", "s2", "s3", "s4"};

// An edge that lies off by so much in x, known to 0.01 in every direction, in three photographs.
EdgeDisplacement OffBy(int edge, double x) {
  EdgeDisplacement found;
  found.edge = edge;
  found.start_in_world = {x, 0, 0};
  found.end_in_world = {x, 0, 0};
  found.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  found.photographs = {0, 1, 3};
  return found;
}

TEST(FindModelErrors, TellsFarLinesFarthestFirstAndWhichTheyAre) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  const double limit = ModelErrorOptions().min_offset_sigmas * edge_model.sigma;
  const std::vector<ModelError> errors = FindModelErrors(
      edge_model, {OffBy(0, 1.5 * limit), OffBy(1, 0.9 * limit), OffBy(2, -3 * limit)}, kNames, {});
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(errors[0].offset_in_world.x(), -3 * limit, 1e-12);
  EXPECT_EQ(errors[0].start_in_world, edge_model.edges[2].start_in_world);
  EXPECT_NEAR(errors[0].sigma, 0.01, 1e-12);
  EXPECT_EQ(errors[0].photographs, (std::vector<std::string>{"s1", "s2", "s4"}));
  EXPECT_NEAR(errors[1].offset_in_world.x(), 1.5 * limit, 1e-12);
}

TEST(FindModelErrors, NeedsPhotographsAndCertainty) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  EdgeDisplacement few = OffBy(0, 1);
  few.photographs = {0, 1};
  EdgeDisplacement uncertain = OffBy(1, 1);
  uncertain.covariance = 0.3 * 0.3 * Eigen::Matrix3d::Identity();  // 3.3 sigmas
  EXPECT_TRUE(FindModelErrors(edge_model, {few, uncertain}, kNames, {}).empty());
  EXPECT_EQ(FindModelErrors(edge_model, {few, uncertain}, kNames, {.min_photographs = 2}).size(),
            1u);
  EXPECT_EQ(FindModelErrors(edge_model, {few, uncertain}, kNames, {.min_sigmas = 3}).size(), 1u);
}

// Three lines of the eaves and one of a wall, which goes elsewhere.
TEST(FindModelErrors, LinesOfOneLevelThatGoTheSameWayAreToldTogether) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  const EdgeGroups& groups = edge_model.groups;
  std::vector<int> level;
  int other = -1;
  for (int edge = 0; edge < static_cast<int>(groups.of_edge.size()); ++edge) {
    bool is_of_level = false;
    for (const EdgeGroupPart& part : groups.of_edge[edge]) {
      is_of_level = is_of_level || part.group == groups.of_edge[0].front().group;
    }
    if (is_of_level) {
      level.push_back(edge);
    } else if (other < 0) {
      other = edge;
    }
  }
  ASSERT_GE(level.size(), 4u);
  ASSERT_GE(other, 0);
  const std::vector<ModelError> errors = FindModelErrors(edge_model,
                                                         {OffBy(level[0], 1),
                                                          OffBy(other, 0.95),
                                                          OffBy(level[1], 0.9),
                                                          OffBy(level[2], 0.85),
                                                          OffBy(level[3], -0.8)},
                                                         kNames,
                                                         {});
  ASSERT_EQ(errors.size(), 5u);
  const auto start_of = [&](int edge) { return edge_model.edges[edge].start_in_world; };
  EXPECT_EQ(errors[0].start_in_world, start_of(level[0]));
  EXPECT_EQ(errors[1].start_in_world, start_of(level[1]));
  EXPECT_EQ(errors[2].start_in_world, start_of(level[2]));
  EXPECT_EQ(errors[3].start_in_world, start_of(other));
  EXPECT_FALSE(errors[0].with_the_one_before);
  EXPECT_TRUE(errors[1].with_the_one_before);
  EXPECT_TRUE(errors[2].with_the_one_before);
  EXPECT_FALSE(errors[3].with_the_one_before);
  EXPECT_FALSE(errors[4].with_the_one_before) << "it goes the other way";
}

}  // namespace
}  // namespace groundglass
