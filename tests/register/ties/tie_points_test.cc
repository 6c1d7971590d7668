// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/tie_points.h"

#include "register/ties/tie_support.h"
#include "tests/register/ties/wall.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// Three photographs of the plaster, and cameras for them.
struct Plaster {
  explicit Plaster(double recess = 0)
      : cameras{CameraBeforeWall(6, 50, 19),
                CameraBeforeWall(20, 46, 21),
                CameraBeforeWall(38, 50, 20)} {
    for (const Camera& camera : cameras) {
      pictures.emplace_back(PhotographPlaster(camera, recess), Image8(), 3);
    }
  }
  std::vector<TieView> Views() const {
    std::vector<TieView> views;
    for (size_t i = 0; i < cameras.size(); ++i) views.push_back({&pictures[i], cameras[i]});
    return views;
  }

  PolygonModel model = MakeWall();
  Visibility visibility{model};
  std::vector<Camera> cameras;
  std::vector<TiePicture> pictures;
};

// The camera as if it stood elsewhere.
Camera Moved(Camera camera, const Eigen::Vector3d& by_in_world) {
  camera.cam_from_world.translation -= camera.cam_from_world.rotation * by_in_world;
  return camera;
}

// The largest distance, px, between where the photographs show a tie point and where its rays from
// the true cameras would, the point on the plane y = `recess` that the first of them shows.
double WorstErrorPx(const TiePoints& ties, const std::vector<Camera>& truth, double recess) {
  double worst = 0;
  for (const TiePoint& point : ties.points) {
    const TieObservation& first = point.observations.front();
    const Camera& camera = truth[first.photograph];
    const Eigen::Vector3d position = camera.PositionInWorld();
    const Eigen::Vector3d ray = UnprojectToWorld(camera, first.image_px);
    const Eigen::Vector3d at = position + (recess - position.y()) / ray.y() * ray;
    for (const TieObservation& seen : point.observations) {
      worst = std::max(worst, (*Project(truth[seen.photograph], at) - seen.image_px).norm());
    }
  }
  return worst;
}

TEST(FindTiePoints, AreWherePhotographsShowTheSame) {
  const Plaster plaster;
  const TiePoints ties = FindTiePoints(plaster.model, plaster.visibility, plaster.Views(), {});
  EXPECT_GT(ties.points.size(), 40u);
  EXPECT_LT(WorstErrorPx(ties, plaster.cameras, 0), 0.3);
  for (const TiePoint& point : ties.points) {
    EXPECT_EQ(point.face, 0);
    EXPECT_GE(point.observations.size(), 2u);
  }
  for (const TieCounts& counts : ties.counts) {
    EXPECT_GT(counts.num_matched, 0.9 * counts.num_tried);
  }
}

TEST(FindTiePoints, AreFoundThroughCamerasThatAreOff) {
  const Plaster plaster;
  std::vector<TieView> views = plaster.Views();
  views[1].camera = Moved(views[1].camera, {0.4, 0, 0});  // some 5 px
  const TiePoints ties = FindTiePoints(plaster.model, plaster.visibility, views, {});
  EXPECT_GT(ties.points.size(), 40u);
  EXPECT_LT(WorstErrorPx(ties, plaster.cameras, 0), 0.3);
}

TEST(FindTiePoints, AreFoundBehindThePlaneToo) {
  const Plaster plaster(0.3);
  const TiePoints ties = FindTiePoints(plaster.model, plaster.visibility, plaster.Views(), {});
  EXPECT_GT(ties.points.size(), 40u);
  EXPECT_LT(WorstErrorPx(ties, plaster.cameras, 0.3), 0.4);
}

TEST(FindTiePointsOf, AreThoseOfOnePhotographOnly) {
  const Plaster plaster;
  const TiePoints ties = FindTiePointsOf(2, plaster.model, plaster.visibility, plaster.Views(), {});
  EXPECT_GT(ties.points.size(), 20u);
  for (const TiePoint& point : ties.points) {
    EXPECT_EQ(point.observations.front().photograph, 2);
  }
}

TieSupport SupportOf(int photograph, const Plaster& plaster, const std::vector<TieView>& views) {
  const TiePoints ties = FindTiePointsOf(photograph, plaster.model, plaster.visibility, views, {});
  return MeasureTieSupport(photograph, ties, views, 0.1, {});
}

TEST(MeasureTieSupport, SpeaksForTheRightCameraAndAgainstOneBesideIt) {
  const Plaster plaster;
  std::vector<TieView> views = plaster.Views();
  const TieSupport right = SupportOf(1, plaster, views);
  EXPECT_GT(right.num_agreeing, 0.9 * right.num_matched);
  EXPECT_GT(right.nats, 2 * right.num_matched);
  EXPECT_TRUE(MayJoin(right, {}));
  // Upwards: stations lie side by side, and what goes sideways might be relief.
  views[1].camera = Moved(views[1].camera, {0, 0, 0.2});
  const TieSupport beside = SupportOf(1, plaster, views);
  EXPECT_LT(beside.num_agreeing, 0.1 * beside.num_matched);
  EXPECT_LT(beside.nats, 0);
  EXPECT_GT(CountedLead(right, beside, {}), 100);
  // It shows the same, though, and the common solution can put it right.
  EXPECT_TRUE(MayJoin(beside, {}));
}

TEST(MeasureTieSupport, ReliefIsNoFault) {
  const Plaster plaster(0.2);
  const std::vector<TieView> views = plaster.Views();
  const TieSupport support = SupportOf(1, plaster, views);
  EXPECT_GT(support.num_agreeing, 0.9 * support.num_matched);
}

TEST(MeasureTieSupport, CountsNoMoreThanSoMany) {
  TieSupport many{1000, 500, 400, 400};
  TieSupport fewer{500, 500, 200, 200};
  TieSupportOptions options;
  options.most_matches = 100;
  EXPECT_DOUBLE_EQ(CountedNats(many, options), 250);
  EXPECT_DOUBLE_EQ(CountedLead(many, fewer, options), 125);
  EXPECT_DOUBLE_EQ(CountedLead(fewer, many, options), -125);
}

TEST(MayJoin, AsksForANumberAndAShare) {
  TieSupportOptions options;
  options.least_matches_to_join = 6;
  options.least_share_to_join = 0.1;
  EXPECT_TRUE(MayJoin({0, 60, 6, 0}, options));
  EXPECT_FALSE(MayJoin({0, 40, 5, 0}, options));
  EXPECT_FALSE(MayJoin({0, 70, 6, 0}, options));
}

TEST(MayJoin, AFewThatAreAllFoundInPlaceAreEnough) {
  TieSupportOptions options;
  options.least_matches_to_join = 6;
  options.least_agreeing_share_to_join = 0.7;
  EXPECT_TRUE(MayJoin({0, 300, 10, 7}, options));
  EXPECT_FALSE(MayJoin({0, 300, 10, 6}, options));
  EXPECT_FALSE(MayJoin({0, 300, 5, 5}, options));
}

}  // namespace
}  // namespace groundglass
