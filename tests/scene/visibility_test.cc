// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/visibility.h"

#include "scene/view_tag.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace groundglass {
namespace {

// Two walls facing south, one behind the other, 2 units apart.
PolygonModel TwoWalls() {
  PolygonModel model;
  model.points_in_world = {
      {-1, 0, 0}, {1, 0, 0}, {1, 0, 2}, {-1, 0, 2}, {-4, 2, 0}, {4, 2, 0}, {4, 2, 4}, {-4, 2, 4}};
  model.faces = {{{0, 1, 2, 3}, "front"}, {{4, 5, 6, 7}, "back"}};
  return model;
}

TEST(Visibility, TheFirstFaceAlongARayAndItsDistance) {
  const Visibility visibility(TwoWalls());
  const auto hit = visibility.FirstHit({0.3, -5, 1}, {0, 1, 0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->face, 0);
  EXPECT_NEAR(hit->distance, 5, 1e-5);
  EXPECT_TRUE(hit->is_front);
  EXPECT_EQ(visibility.FirstHit({0.3, -5, 1}, {0, 1, 0}, 6)->face, 1);
  EXPECT_FALSE(visibility.FirstHit({0.3, -5, 1}, {0, 1, 0}, 0, 4.9));
  EXPECT_FALSE(visibility.FirstHit({0.3, -5, 1}, {0, -1, 0}));
}

TEST(Visibility, NothingIsSeenFromBeyondSinglePrecision) {
  const Visibility visibility(TwoWalls());
  for (const double far : {1e15, 1e38, 1e200}) {
    EXPECT_FALSE(visibility.FirstHit({far, -5, 1}, {0, 1, 0}));
    EXPECT_FALSE(visibility.IsClear({far, -5, 1}, {0, 0, 1}, 1e-3));
  }
}

TEST(Visibility, LeavesAllCoresToTheRestOfTheProgram) {
  const auto num_threads = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const size_t before = num_threads();
  {
    const Visibility first(TwoWalls());
    EXPECT_EQ(num_threads(), before);
    {
      const Visibility second(TwoWalls());
      EXPECT_EQ(num_threads(), before);
    }
    EXPECT_EQ(num_threads(), before);
  }
  EXPECT_EQ(num_threads(), before);
}

TEST(Visibility, AFaceSeenFromBehindIsItsBackAndHidesAllTheSame) {
  const Visibility visibility(TwoWalls());
  const auto hit = visibility.FirstHit({0, 1, 1}, {0, -1, 0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->face, 0);
  EXPECT_FALSE(hit->is_front);
  EXPECT_FALSE(visibility.IsClear({0, 1, 1}, {0, -3, 1}, 1e-3));
}

TEST(Visibility, ClearUntilTheOwnSurfaceBlockedByAnother) {
  const Visibility visibility(TwoWalls());
  EXPECT_TRUE(visibility.IsClear({0, -5, 1}, {0, 0, 1}, 1e-3));
  EXPECT_FALSE(visibility.IsClear({0, -5, 1}, {0, 2, 1}, 1e-3));
  EXPECT_TRUE(visibility.IsClear({3.5, -5, 1}, {3.5, 2, 1}, 1e-3));
}

TEST(Visibility, LabelsCountFacesFromOneAndLeaveBacksOut) {
  const Visibility visibility(TwoWalls());
  ViewTag tag;
  tag.position_in_site = {0, 5, 1};
  tag.lookat_in_site = {0, 0, 1};
  tag.aspect = 1;
  tag.view_angle_deg = 60;
  const Image16 front = visibility.FaceLabels(CameraFromTag(tag, 100, 100));
  EXPECT_EQ(*front.At(50, 50), 1);
  EXPECT_EQ(*front.At(80, 40), 2);
  EXPECT_EQ(*front.At(50, 5), 0);
  tag.position_in_site = {0, -1, 1};
  tag.lookat_in_site = {0, 5, 1};
  EXPECT_EQ(*visibility.FaceLabels(CameraFromTag(tag, 100, 100)).At(50, 50), 0);
}

TEST(Visibility, AConcaveFaceHidesOnlyWhatItCovers) {
  PolygonModel model;
  // A wall with a doorway.
  model.points_in_world = {
      {0, 0, 0}, {2, 0, 0}, {2, 0, 3}, {4, 0, 3}, {4, 0, 0}, {6, 0, 0}, {6, 0, 5}, {0, 0, 5}};
  model.faces = {{{0, 1, 2, 3, 4, 5, 6, 7}, "wall with a doorway"}};
  const Visibility visibility(model);
  EXPECT_TRUE(visibility.FirstHit({1, -5, 1}, {0, 1, 0}));
  EXPECT_FALSE(visibility.FirstHit({3, -5, 1}, {0, 1, 0}));
  EXPECT_TRUE(visibility.FirstHit({3, -5, 4}, {0, 1, 0}));
  EXPECT_TRUE(visibility.FirstHit({5, -5, 1}, {0, 1, 0}));
}

}  // namespace
}  // namespace groundglass
