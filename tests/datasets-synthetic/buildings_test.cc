// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/buildings.h"

#include "datasets-synthetic/occluder_shapes.h"
#include "datasets-synthetic/occluders.h"
#include "scene/check_face.h"
#include "scene/formats/model_io.h"
#include "scene/frames.h"
#include "scene/view_tag.h"
#include "scene/visibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace groundglass {
namespace {

struct NamedSubject {
  std::string name;
  Subject (*make)();
  int min_faces;
  int max_faces;
};

class EachBuilding : public testing::TestWithParam<NamedSubject> {};

TEST_P(EachBuilding, HasSoundNamedFaces) {
  const PolygonModel model = GetParam().make().world.Model();
  EXPECT_GE(static_cast<int>(model.faces.size()), GetParam().min_faces);
  EXPECT_LE(static_cast<int>(model.faces.size()), GetParam().max_faces);
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const FaceCheck check = CheckFace(model, face);
    EXPECT_EQ(check.fault, "") << DescribeFace(model, face);
    EXPECT_EQ(check.warning, "") << DescribeFace(model, face);
    EXPECT_NE(model.faces[face].name, "");
  }
}

// A building without holes and with every face turned outwards.
TEST_P(EachBuilding, ShowsNoBackFacesFromWhereItIsPhotographed) {
  const Subject subject = GetParam().make();
  const Visibility visibility(subject.world.geometry);
  std::set<std::string> backs;
  for (const PlannedView& view : subject.views) {
    ViewTag tag;
    tag.position_in_site = view.position_in_site;
    tag.lookat_in_site = view.lookat_in_site;
    const Camera camera = CameraFromTag(tag, 150, 100);
    int num_model_pixels = 0;
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x < 150; ++x) {
        const auto hit = visibility.FirstHit(camera.PositionInWorld(),
                                             UnprojectToWorld(camera, {x + 0.5, y + 0.5}));
        if (!hit || hit->face >= subject.world.num_model_faces) continue;
        ++num_model_pixels;
        if (!hit->is_front) backs.insert(subject.world.geometry.faces[hit->face].name);
      }
    }
    EXPECT_GT(num_model_pixels, 150 * 100 / 8) << view.name;
  }
  EXPECT_THAT(backs, testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    All,
    EachBuilding,
    testing::Values(NamedSubject{"wiesner", [] { return MakeWiesner(1988); }, 80, 120},
                    NamedSubject{"brick", [] { return MakeBrickHall(1988); }, 60, 90},
                    NamedSubject{"cityblock", [] { return MakeCityBlock(1988, 1000); }, 1000, 1300},
                    NamedSubject{"bigblock", [] { return MakeCityBlock(3, 10000); }, 10000, 11500}),
    [](const auto& test) { return test.param.name; });

TEST(Wiesner, TheThesisViewLooksAtTheEastWall) {
  const PolygonModel model = MakeWiesner(1988).world.Model();
  ViewTag s5;
  s5.position_in_site = {232, -104, 4.5};
  s5.lookat_in_site = {104, -2, 33.1};
  const Camera camera = CameraFromTag(s5, 300, 200);
  const auto hit = Visibility(model).FirstHit(camera.PositionInWorld(), camera.ForwardInWorld());
  ASSERT_TRUE(hit.has_value());
  EXPECT_THAT(model.faces[hit->face].name, testing::HasSubstr("east wall"));
  EXPECT_NEAR((camera.PositionInWorld() + hit->distance * camera.ForwardInWorld()).x(), 104, 1e-3);
}

TEST(Occluders, StandClearOfWallsAndOfPhotographers) {
  Subject subject = MakeWiesner(1988);
  OccluderSite site;
  const Box bounds = ComputeBounds(subject.world.Model());
  site.low = bounds.min.head<2>();
  site.high = bounds.max.head<2>();
  for (const PlannedView& view : subject.views) {
    site.camera_positions.push_back(WorldFromSite(view.position_in_site));
  }
  const size_t num_before = subject.world.geometry.faces.size();
  WorldBuilder builder(subject.world, 5);
  const OccluderCounts counts{.trees = 3, .lamps = 4, .signs = 2, .cars = 1, .people = 3};
  AddStandingOccluders(builder, site, counts, 5);
  AddPassingOccluders(
      builder, site, site.camera_positions[0], Eigen::Vector3d(1, -1, 0.1).normalized(), counts, 5);
  std::set<int> codes;
  for (size_t face = num_before; face < subject.world.geometry.faces.size(); ++face) {
    codes.insert(subject.world.surfaces[face].mask_code);
    for (const int point : subject.world.geometry.faces[face].points) {
      const Eigen::Vector3d& p = subject.world.geometry.points_in_world[point];
      const bool is_in_building = (p.head<2>().array() > site.low.array()).all() &&
                                  (p.head<2>().array() < site.high.array()).all();
      EXPECT_FALSE(is_in_building) << subject.world.geometry.faces[face].name;
      for (const Eigen::Vector3d& camera : site.camera_positions) {
        EXPECT_GT((p - camera).norm(), 3);
      }
    }
  }
  EXPECT_THAT(codes, testing::IsSupersetOf({kTree, kLamp, kSign, kPerson}));
}

// Where a window parts a wall into faces, bricks and stains run on.
TEST(CityBlock, TexturesRunThroughAWallsPieces) {
  const SyntheticWorld world = MakeCityBlock(1988, 1000).world;
  std::vector<int> pieces;
  for (int face = 0; face < world.num_model_faces; ++face) {
    if (world.geometry.faces[face].name == "house 1 south wall") pieces.push_back(face);
  }
  ASSERT_GT(pieces.size(), 5u);
  const Surface& lower = world.surfaces[pieces[0]];
  const Surface& upper = world.surfaces[pieces[1]];
  const double v = lower.high_v;
  EXPECT_EQ(v, upper.low_v);
  for (double u = upper.low_u; u < upper.high_u; u += 0.1) {
    EXPECT_EQ(AppearanceAt(lower, u, v, 0.1, 0.1).albedo,
              AppearanceAt(upper, u, v, 0.1, 0.1).albedo);
  }
}

// The lawn lies lower than the plaza: nobody floats, nobody sinks in.
TEST(Occluders, WhoPassesStandsOnTheGroundThere) {
  for (const double plaza : {500.0, 10.0}) {
    SyntheticWorld world;
    WorldBuilder builder(world, 1);
    OccluderSite site;
    site.low = {-5, -5};
    site.high = {5, 5};
    site.plaza_low = {-plaza, -plaza};
    site.plaza_high = {plaza, plaza};
    AddPassingOccluders(builder, site, {0, -300, 5}, {0, 1, 0}, {.cars = 3, .people = 5}, 1);
    double lowest = 100;
    for (const Eigen::Vector3d& point : world.geometry.points_in_world) {
      lowest = std::min(lowest, point.z());
    }
    EXPECT_NEAR(lowest, plaza < 100 ? kLawnHeight : 0, 0.06) << plaza;
  }
}

// Light depends on which side of a face is its front.
TEST(Occluders, SkinsFaceOutwards) {
  SyntheticWorld world;
  WorldBuilder builder(world, 1);
  const Eigen::Vector3d center(3, 4, 5);
  AddEgg(builder, center, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}, 12, {});
  ASSERT_EQ(world.geometry.faces.size(), 12u * (2 * 6 - 2));
  for (int face = 0; face < static_cast<int>(world.geometry.faces.size()); ++face) {
    const Eigen::Vector3d corner =
        world.geometry.points_in_world[world.geometry.faces[face].points[0]];
    EXPECT_GT(ComputeFacePlane(world.geometry, face).normal_in_world.dot(corner - center), 0);
  }
}

TEST(ContactShadow, KeepsTheSkyFromTheGroundUnderneathAndFadesOut) {
  SyntheticWorld world;
  WorldBuilder(world, 1).AddContactShadow(
      {.center = {10, 20}, .half_length = 7, .half_width = 2, .reach = 3, .strength = 0.8});
  EXPECT_NEAR(world.SkyLeftAt({15, 21}), 0.2, 1e-12);
  EXPECT_NEAR(world.SkyLeftAt({10, 23.5}), 0.6, 1e-12);  // halfway out
  EXPECT_EQ(world.SkyLeftAt({10, 25.5}), 1);
  EXPECT_EQ(world.SkyLeftAt({20.5, 20}), 1);
}

}  // namespace
}  // namespace groundglass
