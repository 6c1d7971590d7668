// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register.h"
#include "scene/formats/image_io.h"
#include "tests/register/photographs_of_house.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// As many pixels as its lines need.
constexpr int kWidth = 450;
constexpr int kHeight = 300;

// The house's east wall is drawn so many feet west of where it was built.
PolygonModel WithAWesternWall(PolygonModel model, double feet) {
  for (Eigen::Vector3d& point : model.points_in_world) {
    if (point.x() == 40) point.x() -= feet;
  }
  return model;
}

// The four photographs of the house as it was built, with the tags that a tape gave, and a plan.
Scene SceneOfHouse(const PolygonModel& plan, const TemporaryFolder& folder) {
  Scene scene;
  scene.folder = folder.path();
  scene.model = plan;
  const PolygonModel built = MakeHouse();
  for (size_t i = 0; i < TrueTagsOfHouse().size(); ++i) {
    Photograph photograph;
    photograph.name = "s" + std::to_string(i + 1);
    photograph.image_file = folder / (photograph.name + ".png");
    photograph.size.width = kWidth;
    photograph.size.height = kHeight;
    photograph.tag = MeasuredTagsOfHouse()[i];
    const Image8 grey8 =
        PhotographModel(built, CameraFromTag(TrueTagsOfHouse()[i], kWidth, kHeight), 2, i + 1);
    Image8 srgb8(kWidth, kHeight, 3);
    for (size_t pixel = 0; pixel < grey8.values.size(); ++pixel) {
      std::fill_n(
          srgb8.values.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, grey8.values[pixel]);
    }
    WriteSrgb8(photograph.image_file, srgb8);
    scene.photographs.push_back(photograph);
  }
  return scene;
}

TEST(RegisterScene, AWallThatIsDrawnBesideItsPlaceIsToldAndDragsNoCamera) {
  const TemporaryFolder folder;
  const Scene scene = SceneOfHouse(WithAWesternWall(MakeHouse(), 1), folder);
  const RegisteredScene registered = RegisterScene(scene, {}, {}, {});
  ASSERT_EQ(registered.registrations.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    const Registration& found = registered.registrations[i];
    EXPECT_EQ(found.verdict, Verdict::kAccepted) << found.name;
    const Camera truth = CameraFromTag(TrueTagsOfHouse()[i], kWidth, kHeight);
    EXPECT_LT(VertexErrorPx(MakeHouse(), truth, found.CorrectedCamera()), 0.4) << found.name;
  }
  ASSERT_EQ(registered.warnings.size(), 1u);
  EXPECT_THAT(registered.warnings[0],
              AllOf(HasSubstr("4 photographs fit much better"), HasSubstr("ft further east")));

  // Its corner with the south wall is 16 ft high; what else is told is of the same wall.
  ASSERT_FALSE(registered.model_errors.empty());
  bool is_corner_told = false;
  for (const ModelError& error : registered.model_errors) {
    EXPECT_EQ(error.start_in_world.x(), 39) << error.name;
    EXPECT_EQ(error.end_in_world.x(), 39) << error.name;
    EXPECT_LT((error.offset_in_world - Eigen::Vector3d(1, 0, 0)).norm(), 0.1) << error.name;
    EXPECT_LT((error.offset_in_world - Eigen::Vector3d(1, 0, 0)).norm(), 3 * error.sigma)
        << error.name;
    EXPECT_GE(error.photographs.size(), 3u) << error.name;
    const Eigen::Vector3d& start = error.start_in_world;
    const Eigen::Vector3d& end = error.end_in_world;
    if (start.y() != 0 || end.y() != 0) continue;
    is_corner_told = true;
    EXPECT_EQ(std::min(start.z(), end.z()), 0);
    EXPECT_EQ((end - start).norm(), 16);
    EXPECT_THAT(error.photographs, ElementsAre("s1", "s2", "s3", "s4"));
  }
  EXPECT_TRUE(is_corner_told);
}

}  // namespace
}  // namespace groundglass
