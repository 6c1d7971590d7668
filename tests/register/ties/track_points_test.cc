// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/track_points.h"

#include "register/ties/find_ties.h"
#include "register/ties/tie_support.h"
#include "tests/register/ties/wall.h"

#include <gtest/gtest.h>

#include <numeric>

namespace groundglass {
namespace {

// Three cameras before the wall and what they see of places on it, `recess` behind it.
struct WallTracks {
  explicit WallTracks(double recess = 0)
      : cameras{CameraBeforeWall(6, 50, 19),
                CameraBeforeWall(20, 46, 21),
                CameraBeforeWall(38, 50, 20)} {
    for (double x = 4; x < 37; x += 3) {
      for (double z = 3; z < 18; z += 3) places_in_world.emplace_back(x, recess, z);
    }
    for (const Eigen::Vector3d& place : places_in_world) {
      FeatureTrack track;
      for (int i = 0; i < 3; ++i) {
        const auto image_px = Project(cameras[i], place);
        if (image_px && IsInsideFrame(cameras[i], *image_px)) track.push_back({i, {*image_px, 2}});
      }
      tracks.push_back(track);
    }
  }
  std::vector<TieView> Views() const {
    const auto shared = std::make_shared<const std::vector<FeatureTrack>>(tracks);
    std::vector<TieView> views;
    for (int i = 0; i < 3; ++i) views.push_back({nullptr, cameras[i], {shared, i, 0}});
    return views;
  }
  TiePoints Placed() const { return PlaceTracks(model, visibility, Views(), {}); }

  PolygonModel model = MakeWall();
  Visibility visibility{model};
  std::vector<Camera> cameras;
  std::vector<Eigen::Vector3d> places_in_world;
  std::vector<FeatureTrack> tracks;
};

TEST(PlaceTracks, EveryTrackOfTheWallLiesWhereItIs) {
  const WallTracks wall;
  const TiePoints ties = wall.Placed();
  ASSERT_EQ(ties.points.size(), wall.tracks.size());
  for (size_t i = 0; i < ties.points.size(); ++i) {
    EXPECT_EQ(ties.points[i].face, 0);
    EXPECT_LT((ties.points[i].point_in_world - wall.places_in_world[i]).norm(), 1e-4);
    EXPECT_LT((ties.points[i].normal_in_world + Eigen::Vector3d::UnitY()).norm(), 1e-6);
    EXPECT_EQ(ties.points[i].observations.size(), wall.tracks[i].size());
    const TieObservation& first = ties.points[i].observations.front();
    // hypot(0.15, 0.08 * 2) px.
    EXPECT_NEAR(first.root_precision(0, 0), 1 / 0.2193, 1e-2);
    EXPECT_EQ(first.root_precision(0, 1), 0);
  }
  for (const TieCounts& counts : ties.counts) EXPECT_EQ(counts.num_matched, counts.num_tried);
}

TEST(PlaceTracks, AWallSetBackFromTheModelIsNoFault) {
  const WallTracks wall(0.5);
  const TiePoints ties = wall.Placed();
  EXPECT_EQ(ties.points.size(), wall.tracks.size());
  for (const TiePoint& point : ties.points) EXPECT_NEAR(point.point_in_world.y(), 0, 1e-5);
}

TEST(PlaceTracks, AWrongMatchIsLeftOutAndTheOthersOfItsTrackStay) {
  WallTracks wall;
  FeatureTrack& track = wall.tracks[22];
  ASSERT_EQ(track.size(), 3u);
  track[1].keypoint.image_px += Eigen::Vector2d(10, 40);
  const TiePoints ties = wall.Placed();
  ASSERT_EQ(ties.points.size(), wall.tracks.size());
  const TiePoint& point = ties.points[22];
  ASSERT_EQ(point.observations.size(), 2u);
  EXPECT_EQ(point.observations[0].photograph, 0);
  EXPECT_EQ(point.observations[1].photograph, 2);
  EXPECT_EQ(ties.counts[1].num_tried - ties.counts[1].num_matched, 2);
}

TEST(PlaceTracks, TheGateFollowsWhatTheCamerasLeaveUncertain) {
  WallTracks wall;
  FeatureTrack& track = wall.tracks[22];
  track = {track[0], track[2]};
  // Across the epipolar line, which no relief explains.
  track[1].keypoint.image_px.y() += 30;
  std::vector<TieView> views = wall.Views();
  const size_t num_tracks = wall.tracks.size();
  EXPECT_EQ(PlaceTracks(wall.model, wall.visibility, views, {}).points.size(), num_tracks - 1);
  for (TieView& view : views) view.followed.sigma_px = 4;
  EXPECT_EQ(PlaceTracks(wall.model, wall.visibility, views, {}).points.size(), num_tracks);
}

TEST(PlaceTracks, RaysThatMeetNothingOrDifferentFacesGiveNoPoint) {
  WallTracks wall;
  wall.tracks = {{{0, {{300, 2}, 2}}, {1, {{300, 2}, 2}}},       // the sky
                 {{0, {{300, 200}, 2}}, {1, {{300, 395}, 2}}}};  // the wall and the ground
  const TiePoints ties = wall.Placed();
  EXPECT_TRUE(ties.points.empty());
  EXPECT_EQ(ties.counts[0].num_tried, 2);
  EXPECT_EQ(ties.counts[0].num_matched, 0);
}

TEST(PlaceTracks, ViewsAreToldByTheirNumbersInTheTracks) {
  const WallTracks wall;
  std::vector<TieView> views = wall.Views();
  views = {views[2], views[0]};
  const TiePoints ties = PlaceTracks(wall.model, wall.visibility, views, {});
  ASSERT_FALSE(ties.points.empty());
  for (const TiePoint& point : ties.points) {
    ASSERT_EQ(point.observations.size(), 2u);
    for (const TieObservation& seen : point.observations) {
      EXPECT_LT(
          (*Project(views[seen.photograph].camera, point.point_in_world) - seen.image_px).norm(),
          1e-3);
    }
  }
}

TEST(PlaceTracks, OfManyTracksTheLongestAndSharpestAreKept) {
  WallTracks wall;
  FeatureTrack blurred = wall.tracks[22];
  for (TrackedKeypoint& tracked : blurred) tracked.keypoint.scale_px = 20;
  FeatureTrack sharp = wall.tracks[22];
  for (TrackedKeypoint& tracked : sharp) tracked.keypoint.scale_px = 1;
  wall.tracks.assign(10, blurred);
  wall.tracks.push_back(sharp);
  TrackOptions options;
  options.most_per_cell = 2;
  const TiePoints ties = PlaceTracks(wall.model, wall.visibility, wall.Views(), options);
  ASSERT_EQ(ties.points.size(), 2u);
  EXPECT_GT(ties.points[1].observations[0].root_precision(0, 0),
            5 * ties.points[0].observations[0].root_precision(0, 0));
}

TEST(FindTies, TracksSpeakForTheRightCameraAndAgainstOneBesideIt) {
  const WallTracks wall;
  TieOptions options;
  options.use_patches = false;
  const auto support_of = [&](const std::vector<TieView>& views) {
    return MeasureTieSupport(
        2, FindTiesOf(2, wall.model, wall.visibility, views, options), views, 0.1, {});
  };
  std::vector<TieView> views = wall.Views();
  const TieSupport right = support_of(views);
  EXPECT_GT(right.num_matched, 60);
  EXPECT_GT(right.nats, 100);
  // A hand's breadth up: some three pixels.
  views[2].camera.cam_from_world.translation -=
      views[2].camera.cam_from_world.rotation * Eigen::Vector3d(0, 0, 0.5);
  EXPECT_LT(support_of(views).nats, 0.3 * right.nats);
}

TEST(FindTies, WithoutTracksAndPatchesThereIsNothing) {
  const WallTracks wall;
  TieOptions options;
  options.use_patches = false;
  std::vector<TieView> views = wall.Views();
  for (TieView& view : views) view.followed = {};
  const TiePoints ties = FindTies(wall.model, wall.visibility, views, options);
  EXPECT_TRUE(ties.points.empty());
  EXPECT_EQ(ties.counts.size(), views.size());
}

}  // namespace
}  // namespace groundglass
