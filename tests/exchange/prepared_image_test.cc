// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/prepared_image.h"

#include "tests/exchange/test_camera.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(PreparedCamera, IsTheSameWhereNothingIsNeeded) {
  const Camera camera = OffCentreCamera();
  EXPECT_TRUE(IsSameFrame(PreparedCamera(camera, {}), camera));
  EXPECT_TRUE(IsSameFrame(PreparedCamera(camera, {.no_distortion = true}), camera));
}

TEST(PreparedCamera, ACentredFrameReachesAsFarOnBothSides) {
  const Camera prepared = PreparedCamera(OffCentreCamera(), {.centred = true});
  EXPECT_EQ(prepared.width_px, 1480);
  EXPECT_EQ(prepared.height_px, 942);
  EXPECT_EQ(prepared.center_x_px, 740);
  EXPECT_EQ(prepared.center_y_px, 471);
  EXPECT_EQ(prepared.focal_x_px, OffCentreCamera().focal_x_px);
}

TEST(PreparedCamera, SquarePixelsAreTheFinerOfTheTwo) {
  const Camera prepared = PreparedCamera(OffCentreCamera(), {.square_pixels = true});
  EXPECT_EQ(prepared.focal_x_px, 1220.574);
  EXPECT_EQ(prepared.focal_y_px, 1220.574);
  EXPECT_NEAR(prepared.width_px, 1200 * 1220.574 / 1158.336, 1);
  EXPECT_EQ(prepared.height_px, 800);
}

// A picture whose colour says where it is: the place that a point has in the prepared picture shows
// the colour of the place that it has in the photograph.
TEST(PrepareImage, EachPlaceKeepsItsColour) {
  Camera camera = ResizedCamera(OffCentreCamera(), 240, 160);
  camera.k1 = -0.15;
  Image8 coded(240, 160, 3);
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 240; ++x) {
      coded.At(x, y)[0] = static_cast<uint8_t>(x);
      coded.At(x, y)[1] = static_cast<uint8_t>(y);
    }
  }
  const Camera prepared = PreparedCamera(camera, {true, true, true});
  EXPECT_FALSE(prepared.IsDistorted());
  const PreparedImage image = PrepareImage(coded, camera, prepared);
  int num_compared = 0;
  for (const Eigen::Vector2d& px : {Eigen::Vector2d(20, 20),
                                    Eigen::Vector2d(120, 80),
                                    Eigen::Vector2d(60.3, 130.8),
                                    Eigen::Vector2d(215, 145)}) {
    const Eigen::Vector3d place =
        Inverse(camera.cam_from_world) * Eigen::Vector3d(20 * UnprojectToCam(camera, px));
    const auto before = Project(camera, place);
    const auto after = Project(prepared, place);
    if (!before || !after || before->x() < 2 || before->y() < 2 || before->x() > 238 ||
        before->y() > 158) {
      continue;
    }
    const int x = static_cast<int>(after->x());
    const int y = static_cast<int>(after->y());
    EXPECT_EQ(*image.mask.At(x, y), 255);
    EXPECT_NEAR(image.srgb8.At(x, y)[0], before->x() - 0.5, 1.2);
    EXPECT_NEAR(image.srgb8.At(x, y)[1], before->y() - 0.5, 1.2);
    ++num_compared;
  }
  EXPECT_GE(num_compared, 4);
}

}  // namespace
}  // namespace groundglass
