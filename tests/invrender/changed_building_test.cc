// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

// When it was photographed: a wall of 20 x 12 with a red shed before its right end. Since then the
// shed has gone, the wall was made four feet longer, and a porch stands before its left end.
struct ChangedBuilding {
  TemporaryFolder folder;
  PolygonModel then;
  PolygonModel now;
  int wall = 0;
  int porch = 0;
  std::vector<BakePhotograph> photographs;

  ChangedBuilding() {
    AddWall(then, 0, 20, 0, 12);
    AddWall(then, 14, 18, 0, 5, -3);  // the shed's front
    AddFace(then, {{14, 0, 0}, {14, -3, 0}, {14, -3, 5}, {14, 0, 5}});
    AddFace(then, {{18, -3, 0}, {18, 0, 0}, {18, 0, 5}, {18, -3, 5}});
    AddFace(then, {{14, -3, 5}, {18, -3, 5}, {18, 0, 5}, {14, 0, 5}});
    porch = AddWall(now, 2, 6, 0, 6, -4);
    wall = AddWall(now, 0, 24, 0, 12);
    const Paint paint = [](int face, const Eigen::Vector3d& point) -> Eigen::Array3f {
      return face == 0 ? Waves(point) : Eigen::Array3f(0.9f, 0.02f, 0.02f);
    };
    for (const double x : {8.0, 12.0}) {
      photographs.push_back(PhotographPainted(then,
                                              LookAt({x, -26, 6}, {11, 0, 6}, 480, 320, 380),
                                              paint,
                                              folder.path(),
                                              "x" + std::to_string(static_cast<int>(x))));
    }
  }
};

TEST(ChangedBuilding, WhatStayedIsTexturedAndWhatIsNewStaysPlain) {
  const ChangedBuilding building;
  BakeOptions options;
  options.match_colour = false;
  options.reject_occluders = false;
  options.as_photographed = building.then;
  const BakeResult result = BakeTextures(building.now, building.photographs, options);
  EXPECT_THAT(result.new_faces, testing::ElementsAre(building.porch));
  EXPECT_EQ(result.model.faces[building.porch].page, -1);
  long num_behind_porch = 0;
  for (const PlacedTexel& texel : TexelsOf(result.model, building.wall)) {
    const Eigen::Vector3d& point = texel.point_in_world;
    // Within a foot of where the shed hid the wall from all photographs, or from one, nothing is
    // said but that no red is there.
    const bool is_beside_shed = point.x() > 12.5 && point.x() < 20 && point.z() < 7;
    if (texel.source != kProvenanceNone) {
      // The last texels before the border repeat those farther in.
      const float limit = is_beside_shed ? 0.25f : texel.texels_from_border < 5 ? 0.12f : 0.06f;
      ASSERT_LT((texel.radiance - Waves(point)).abs().maxCoeff(), limit) << point.transpose();
    }
    if (point.x() > 20.2) {
      ASSERT_EQ(texel.source, kProvenanceNone) << point.transpose();
    } else if (point.x() > 15 && point.x() < 17.5 && point.z() < 4) {
      ASSERT_EQ(texel.source, kProvenanceNone) << point.transpose();
    } else if (!is_beside_shed && point.x() < 19.8) {
      ASSERT_NE(texel.source, kProvenanceNone) << point.transpose();
      num_behind_porch += point.x() > 2.5 && point.x() < 5.5 && point.z() < 5 ? 1 : 0;
    }
  }
  EXPECT_GT(num_behind_porch, 1000);  // photographed before the porch was built
}

TEST(ChangedBuilding, WithoutTheEarlierModelTheShedIsPrintedOnTheWall) {
  const ChangedBuilding building;
  BakeOptions options;
  options.reject_occluders = false;
  const BakeResult result = BakeTextures(building.now, building.photographs, options);
  EXPECT_TRUE(result.new_faces.empty());
  long num_red = 0;
  for (const PlacedTexel& texel : TexelsOf(result.model, building.wall)) {
    num_red += texel.radiance[0] > 0.7f ? 1 : 0;
  }
  EXPECT_GT(num_red, 1000);
}

}  // namespace
}  // namespace groundglass
