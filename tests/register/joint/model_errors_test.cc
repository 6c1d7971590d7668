// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/model_errors.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// An edge that lies off by so much in x, known to 0.01 in every direction, in three photographs.
EdgeDisplacement OffBy(int edge, double x) {
  EdgeDisplacement found;
  found.edge = edge;
  found.start_in_world = {x, 0, 0};
  found.end_in_world = {x, 0, 0};
  found.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  found.num_photographs = 3;
  return found;
}

TEST(FindModelErrors, TellsFarLinesFarthestFirstAndWhichTheyAre) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  const double limit = ModelErrorOptions().min_offset_sigmas * edge_model.sigma;
  const std::vector<ModelError> errors = FindModelErrors(
      edge_model, {OffBy(0, 1.5 * limit), OffBy(1, 0.9 * limit), OffBy(2, -3 * limit)}, {});
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(errors[0].offset_in_world.x(), -3 * limit, 1e-12);
  EXPECT_EQ(errors[0].start_in_world, edge_model.edges[2].start_in_world);
  EXPECT_NEAR(errors[0].sigma, 0.01, 1e-12);
  EXPECT_NEAR(errors[1].offset_in_world.x(), 1.5 * limit, 1e-12);
}

TEST(FindModelErrors, NeedsPhotographsAndCertainty) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  EdgeDisplacement few = OffBy(0, 1);
  few.num_photographs = 2;
  EdgeDisplacement uncertain = OffBy(1, 1);
  uncertain.covariance = 0.3 * 0.3 * Eigen::Matrix3d::Identity();  // 3.3 sigmas
  EXPECT_TRUE(FindModelErrors(edge_model, {few, uncertain}, {}).empty());
  EXPECT_EQ(FindModelErrors(edge_model, {few, uncertain}, {.min_photographs = 2}).size(), 1u);
  EXPECT_EQ(FindModelErrors(edge_model, {few, uncertain}, {.min_sigmas = 3}).size(), 1u);
}

}  // namespace
}  // namespace groundglass
