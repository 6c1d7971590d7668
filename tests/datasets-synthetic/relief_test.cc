// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/relief.h"

#include "datasets-synthetic/buildings.h"
#include "scene/view_tag.h"
#include "scene/visibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace groundglass {
namespace {

int FaceNamed(const PolygonModel& model, const std::string& name) {
  for (size_t face = 0; face < model.faces.size(); ++face) {
    if (model.faces[face].name == name) return static_cast<int>(face);
  }
  return -1;
}

class Relief : public testing::Test {
 protected:
  Relief() : world_(MakeWiesner(1988).world), model_(world_.Model()) {
    AddRelief(1, Rgb(0.6f, 0.6f, 0.6f), 1988, world_);
  }
  SyntheticWorld world_;
  PolygonModel model_;
};

TEST_F(Relief, WindowsLieBehindTheWallAndTheModelKeepsThemInIt) {
  const int window = FaceNamed(model_, "east wall south part windows 1");
  ASSERT_GE(window, 0);
  const Visibility visibility(world_.geometry);
  // From the east, to the middle of the band: x 104 on the model.
  const auto hit = visibility.FirstHit({204, -18, 20.5}, {-1, 0, 0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->face, window);
  EXPECT_GT(hit->distance, 100.29);
  EXPECT_LT(hit->distance, 100.61);
  EXPECT_TRUE(hit->is_front);
  for (const int point : model_.faces[window].points) {
    EXPECT_EQ(model_.points_in_world[point].x(), 104);
  }
}

TEST_F(Relief, CornersAreRound) {
  // The corner's middle, at 45 degrees: 10 ft from the centre, where the model's flat face is
  // 10 cos 15 away.
  const Eigen::Vector2d center(94, 30);
  const Eigen::Vector3d outward = Eigen::Vector3d(1, 1, 0).normalized();
  const Eigen::Vector3d from = Eigen::Vector3d(center.x(), center.y(), 30) + 50 * outward;
  const auto round = Visibility(world_.geometry).FirstHit(from, -outward);
  const auto flat = Visibility(model_).FirstHit(from, -outward);
  ASSERT_TRUE(round && flat);
  EXPECT_NEAR(round->distance, 40, 0.01);
  EXPECT_NEAR(flat->distance, 50 - 10 * std::cos(15 * EIGEN_PI / 180), 1e-3);
  EXPECT_TRUE(world_.surfaces[round->face].is_relief);
}

// Reveals, sills and arcs close up with their neighbours: no ray from outside meets a back.
TEST_F(Relief, LeavesNoHoles) {
  const Visibility visibility(world_.geometry);
  std::set<std::string> backs;
  for (const PlannedView& view : MakeWiesner(1988).views) {
    ViewTag tag;
    tag.position_in_site = view.position_in_site;
    tag.lookat_in_site = view.lookat_in_site;
    const Camera camera = CameraFromTag(tag, 450, 300);
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const auto hit = visibility.FirstHit(camera.PositionInWorld(),
                                             UnprojectToWorld(camera, {x + 0.5, y + 0.5}));
        if (!hit || hit->is_front) continue;
        if (hit->face < world_.num_model_faces || world_.surfaces[hit->face].is_relief) {
          backs.insert(view.name + ": " + world_.geometry.faces[hit->face].name);
        }
      }
    }
  }
  EXPECT_THAT(backs, testing::IsEmpty());
}

TEST(PaintPlainly, NeighboursDifferAndBordersAreEven) {
  SyntheticWorld world = MakeWiesner(1988).world;
  PaintPlainly(1988, world);
  const PolygonModel model = world.Model();
  const int low = FaceNamed(model, "east wall south part tiles 1");
  const int window = FaceNamed(model, "east wall south part windows 1");
  EXPECT_GT(std::abs(world.surfaces[low].color[1] - world.surfaces[window].color[1]), 0.1f);
  const Surface& wall = world.surfaces[low];
  const double middle_v = (wall.low_v + wall.high_v) / 2;
  const Rgb border = AppearanceAt(wall, wall.low_u + 0.5, middle_v, 0.1, 0.1).albedo;
  EXPECT_EQ(border, wall.color);
  std::set<float> inside;
  for (double u = wall.low_u + 4; u < wall.high_u - 4; u += 2) {
    inside.insert(AppearanceAt(wall, u, middle_v, 0.1, 0.1).albedo[1]);
  }
  EXPECT_GT(*inside.rbegin() - *inside.begin(), 0.03 * wall.color[1]);
}

}  // namespace
}  // namespace groundglass
