// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/flat_patch.h"

#include "tests/register/ties/wall.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

FlatPatch PatchOnWall() {
  FlatPatch patch = LayPatch({21, 0, 9}, 0, -Eigen::Vector3d::UnitY());
  patch.texel = 0.15;
  return patch;
}

TEST(LayPatch, RowsAreLevelAndRunToTheRight) {
  const FlatPatch patch = PatchOnWall();
  // The wall faces south: east is on the right.
  EXPECT_TRUE(patch.across_in_world.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(patch.down_in_world.isApprox(-Eigen::Vector3d::UnitZ()));
  const FlatPatch roof = LayPatch({0, 0, 0}, 0, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(roof.across_in_world.dot(roof.down_in_world), 0, 1e-12);
  EXPECT_NEAR(roof.across_in_world.cross(roof.down_in_world).z(), -1, 1e-12);
}

TEST(ImageByPoint, MatchesFiniteDifferences) {
  Camera camera = CameraBeforeWall(4, 50, 22);
  camera.k1 = -0.1;
  camera.p1 = 0.003;
  const Eigen::Vector3d point(17, -1, 12);
  const auto derivative = ImageByPoint(camera, point);
  ASSERT_TRUE(derivative);
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double kStep = 1e-5;
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector2d numeric =
        (*Project(camera, point + step) - *Project(camera, point - step)) / (2 * kStep);
    EXPECT_LT((derivative->col(axis) - numeric).norm(), 1e-4);
  }
  EXPECT_FALSE(ImageByPoint(camera, {17, -90, 12}));  // behind it
}

TEST(FlattenPatch, ShowsWhatIsOnTheWall) {
  const Camera camera = CameraBeforeWall(-5, 45, 22);
  const TiePicture picture(PhotographPlaster(camera, 0), {}, 3);
  const FlatPatch patch = PatchOnWall();
  const auto flat = FlattenPatch(patch, 24, camera, picture);
  ASSERT_TRUE(flat);
  double squares = 0;
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column < 24; ++column) {
      const Eigen::Vector3d at = patch.PointInWorld({column - 11.5, row - 11.5});
      const double error = *flat->At(column, row) - PlasterLight(at.x(), at.z());
      squares += error * error;
    }
  }
  EXPECT_LT(std::sqrt(squares / (24 * 24)), 0.02);
}

TEST(FlattenPatch, IsNothingWhereThePhotographIsNoEvidence) {
  const Camera camera = CameraBeforeWall(20, 45, 20);
  const Image8 photograph = PhotographPlaster(camera, 0);
  Image8 ignore(photograph.width, photograph.height, 1);
  const auto at = Project(camera, PatchOnWall().center_in_world);
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      *ignore.At(static_cast<int>(at->x()) + x, static_cast<int>(at->y()) + y) = 255;
    }
  }
  EXPECT_TRUE(FlattenPatch(PatchOnWall(), 24, camera, TiePicture(photograph, {}, 3)));
  EXPECT_FALSE(FlattenPatch(PatchOnWall(), 240, camera, TiePicture(photograph, {}, 3)));
  EXPECT_FALSE(FlattenPatch(PatchOnWall(), 24, camera, TiePicture(photograph, ignore, 3)));
}

TEST(IsPatchClear, IsNotWhereSomethingStandsBeforeItOrTheWallEnds) {
  PolygonModel model = MakeWall();
  const Camera camera = CameraBeforeWall(20, 45, 20);
  EXPECT_TRUE(IsPatchClear(PatchOnWall(), 24, camera, Visibility(model)));
  EXPECT_FALSE(IsPatchClear(PatchOnWall(), 240, camera, Visibility(model)));
  const int first = static_cast<int>(model.points_in_world.size());
  for (const double z : {0.0, 30.0}) {
    model.points_in_world.push_back({20.6, -3, z});
    model.points_in_world.push_back({21.3, -3, z});
  }
  model.faces.push_back({{first, first + 1, first + 3, first + 2}, "post"});
  EXPECT_FALSE(IsPatchClear(PatchOnWall(), 24, camera, Visibility(model)));
}

}  // namespace
}  // namespace groundglass
