// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/control_points.h"

#include "register/camera/control_point_cost.h"
#include "register/camera/control_point_posterior.h"
#include "register/camera/parameter_projection.h"
#include "register/register.h"
#include "scene/formats/atomic_file.h"
#include "scene/frames.h"
#include "tests/register/house.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

using testing::HasSubstr;

ViewTag SlidTag() {
  ViewTag tag;
  tag.position_in_site = {62, 48, 5};
  tag.lookat_in_site = {20, -4, 11};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  tag.roll_deg = 0.7;
  tag.shift_x = 0.008;
  return tag;
}

// Written down from memory: feet off, and said to be so.
ViewTag RememberedTag() {
  ViewTag tag = SlidTag();
  tag.roll_deg = 0;
  tag.shift_x = 0;
  tag.position_in_site += Eigen::Vector3d(-22, 30, 6);
  tag.lookat_in_site += Eigen::Vector3d(20, 14, -9);
  tag.view_angle_deg *= 1.1;
  tag.sigmas.position = 30;
  tag.sigmas.height = 8;
  tag.sigmas.lookat = 20;
  tag.sigmas.view_angle_deg = 5;
  return tag;
}

// A person points at corners of the house, as well as a person can.
std::vector<ControlPoint> PointAtHouse(const std::vector<Eigen::Vector3d>& points_in_world,
                                       double sigma_px) {
  const Camera camera = CameraFromTag(SlidTag(), kPhotoWidth, kPhotoHeight);
  std::mt19937_64 random(4);
  std::normal_distribution<double> error(0, sigma_px);
  std::vector<ControlPoint> points;
  for (const Eigen::Vector3d& point : points_in_world) {
    const Eigen::Vector2d pointing(error(random), error(random));
    points.push_back({"s1", *Project(camera, point) + pointing, point, sigma_px});
  }
  return points;
}

// South-west foot, south-east eave, ridge's east end, chimney's top.
const std::vector<Eigen::Vector3d> kCorners = {{0, 0, 0}, {40, 0, 16}, {40, 10, 24}, {30, 3, 27}};

TEST(ControlPoints, AFileIsReadInTheSiteFrame) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder / "a.points",
                      "% corners pointed at in the viewer\n"
                      "s1  10.5 20   1 2 3   2\n"
                      "s1  30 40     4 5 6   1.5 % eave\n\n"
                      "s1  50 60     7 8 9   2\n");
  const std::vector<ControlPoint> points = ReadControlPoints(folder / "a.points");
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1].photograph, "s1");
  EXPECT_EQ(points[1].image_px, Eigen::Vector2d(30, 40));
  EXPECT_EQ(points[1].point_in_world, WorldFromSite({4, 5, 6}));
  EXPECT_EQ(points[1].sigma_px, 1.5);
}

TEST(ControlPoints, FaultsNameFileAndLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    WriteFileAtomically(folder / "a.points", text);
    return ThrownMessage([&] { ReadControlPoints(folder / "a.points"); });
  };
  EXPECT_THAT(message("s1 1 2 3 4 5\n"),
              HasSubstr("a.points:1: expected 7 words, photograph x_px y_px x y z sigma_px; "
                        "found 6"));
  EXPECT_THAT(message("% two\ns1 1 2 3 oops 5 2\n"),
              HasSubstr("a.points:2: y: 'oops' is not a finite number"));
  EXPECT_THAT(message("s1 1 2 3 4 5 0\n"),
              HasSubstr("a.points:1: sigma_px: a standard deviation must be above 0"));
  EXPECT_THAT(message("s1 1 2 3 4 5 2\ns1 1 2 3 4 5 2\n"),
              HasSubstr("a.points:1: photograph 's1' has 2 points; three or more are needed"));
  EXPECT_THAT(message("% nothing\n"), HasSubstr("a.points: there is no point in it"));
  EXPECT_THAT(message("s1 1 2 3 4 5 2\ns1 6 7 3 4 5 2\ns1 8 9 3 4 9 2\n"),
              HasSubstr("a.points:1: photograph 's1' has points at 2 places of the model"));
}

TEST(ControlPoints, ThoseOnOneLineAreTold) {
  std::vector<ControlPoint> points = {
      {"s1", {10, 10}, {0, 0, 0}}, {"s1", {20, 10}, {9, 0, 0}}, {"s1", {15, 10}, {4, 0, 0}}};
  EXPECT_THAT(DescribeThinControlPoints("a.points", points),
              testing::ElementsAre(HasSubstr("a.points: the points of 's1' lie on one line")));
  points.push_back({"s1", {20, 20}, {9, 0, 9}});
  EXPECT_THAT(DescribeThinControlPoints("a.points", points), testing::IsEmpty());
}

TEST(ControlPoints, AreRefusedFarFromModelAndPicture) {
  Scene scene;
  scene.model.points_in_world = {{0, 0, 0}, {9, 0, 0}, {9, 0, 9}};
  scene.model.faces = {{{0, 1, 2}, ""}};
  scene.photographs.emplace_back().name = "s1";
  scene.photographs[0].size = {640, 427};
  const auto message = [&](const Eigen::Vector2d& image_px, const Eigen::Vector3d& point) {
    return ThrownMessage([&] { CheckControlPoints("a.points", {{"s1", image_px, point}}, scene); });
  };
  EXPECT_EQ(message({700, -10}, {9, 0, 30}), "nothing was thrown");
  EXPECT_THAT(message({9999, 10}, {9, 0, 9}),
              HasSubstr("a.points: a point of 's1' is at 9999 10 pixels, outside its picture"));
  EXPECT_THAT(message({10, 10}, {9, 0, 9000}),
              HasSubstr("a point of 's1' is at 9 0 9000, far from the model"));
}

TEST(ControlPointCost, DerivativesAreThoseOfTheResiduals) {
  ViewTag tag = SlidTag();
  tag.k2 = 0.01;
  const CameraPrior prior =
      MakeCameraPrior(tag, kPhotoWidth, kPhotoHeight, LengthUnit::kFoot, {}, {});
  const std::vector<ControlPoint> points = PointAtHouse(kCorners, 2);
  const ControlPointCost cost(points, prior);
  const int count = cost.num_residuals();
  ASSERT_EQ(count, 8);
  CameraParameters whitened = CameraParameters::Constant(0.3);
  const double* block = whitened.data();
  Eigen::VectorXd residuals(count);
  Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor> jacobian(
      count, kNumCameraParameters);
  double* jacobians[] = {jacobian.data()};
  ASSERT_TRUE(cost.Evaluate(&block, residuals.data(), jacobians));
  for (int i = 0; i < kNumCameraParameters; ++i) {
    constexpr double kStep = 1e-5;
    Eigen::VectorXd ahead(count);
    Eigen::VectorXd behind(count);
    whitened[i] += kStep;
    ASSERT_TRUE(cost.Evaluate(&block, ahead.data(), nullptr));
    whitened[i] -= 2 * kStep;
    ASSERT_TRUE(cost.Evaluate(&block, behind.data(), nullptr));
    whitened[i] += kStep;
    EXPECT_LT(((ahead - behind) / (2 * kStep) - jacobian.col(i)).norm(),
              1e-6 * (1 + jacobian.col(i).norm()))
        << kCameraParameterNames[i];
  }
}

TEST(ControlPointCost, ResidualsAreInSigmas) {
  const CameraPrior prior =
      MakeCameraPrior(SlidTag(), kPhotoWidth, kPhotoHeight, LengthUnit::kFoot, {}, {});
  std::vector<ControlPoint> points = PointAtHouse({kCorners[0]}, 2);
  points[0].image_px = *Project(CameraFromTag(SlidTag(), kPhotoWidth, kPhotoHeight), kCorners[0]) -
                       Eigen::Vector2d(6, -3);
  const ControlPointCost cost(points, prior);
  const CameraParameters whitened = CameraParameters::Zero();
  const double* block = whitened.data();
  Eigen::Vector2d residuals;
  ASSERT_TRUE(cost.Evaluate(&block, residuals.data(), nullptr));
  EXPECT_NEAR(residuals.x(), 3, 1e-9);
  EXPECT_NEAR(residuals.y(), -1.5, 1e-9);
}

TEST(ControlPointPosterior, WithoutPointsItIsTheTags) {
  const CameraPrior prior =
      MakeCameraPrior(SlidTag(), kPhotoWidth, kPhotoHeight, LengthUnit::kFoot, {}, {});
  const ControlPointPosterior pointed = ConditionOnControlPoints({}, prior);
  EXPECT_EQ(pointed.prior.mean, prior.mean);
  EXPECT_EQ(pointed.prior.root, prior.root);
  EXPECT_EQ(pointed.map, CameraCovariance::Identity());
}

TEST(ControlPointPosterior, BothWaysOfSayingItAgree) {
  const CameraPrior prior =
      MakeCameraPrior(RememberedTag(), kPhotoWidth, kPhotoHeight, LengthUnit::kFoot, {}, {});
  const ControlPointPosterior pointed = ConditionOnControlPoints(PointAtHouse(kCorners, 2), prior);
  const CameraParameters v = CameraParameters::LinSpaced(-1, 1);
  EXPECT_LT((pointed.prior.mean + pointed.prior.root * v -
             (prior.mean + prior.root * (pointed.offset + pointed.map * v)))
                .norm(),
            1e-9);
  EXPECT_TRUE((pointed.prior.sigmas.array() <= prior.sigmas.array() + 1e-12).all());
}

TEST(RegisterPhotograph, FourPointsSolveAStartThatEdgesCannot) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  const Camera truth = CameraFromTag(SlidTag(), kPhotoWidth, kPhotoHeight);
  const Image8 photograph = PhotographModel(model, truth, 2, 1);
  const Registration alone =
      RegisterPhotograph({"s1", photograph, {}, RememberedTag(), {}}, edge_model, {});
  EXPECT_GT(VertexErrorPx(model, truth, alone.MeasuredCamera()), 80);
  EXPECT_TRUE(alone.verdict != Verdict::kAccepted ||
              VertexErrorPx(model, truth, alone.CorrectedCamera()) > 3);

  RegisterOptions options;
  options.control_points = PointAtHouse(kCorners, 2);
  const Registration helped =
      RegisterPhotograph({"s1", photograph, {}, RememberedTag(), {}}, edge_model, options);
  EXPECT_EQ(helped.verdict, Verdict::kAccepted)
      << (helped.reasons.empty() ? "" : helped.reasons.front());
  EXPECT_LT(VertexErrorPx(model, truth, helped.CorrectedCamera()), 0.5)
      << VertexErrorPx(model, truth, alone.MeasuredCamera()) << " "
      << VertexErrorPx(model, truth, alone.CorrectedCamera());
}

TEST(RegisterPhotograph, AMistypedPointIsNamed) {
  const PolygonModel model = MakeHouse();
  const Camera truth = CameraFromTag(SlidTag(), kPhotoWidth, kPhotoHeight);
  RegisterOptions options;
  options.control_points = PointAtHouse(kCorners, 2);
  options.control_points[2].image_px.x() += 100;
  const Registration registration = RegisterPhotograph(
      {"s1", PhotographModel(model, truth, 2, 1), {}, SlidTag(), {}}, EdgeModel(model), options);
  EXPECT_NE(registration.verdict, Verdict::kAccepted);
  EXPECT_THAT(registration.reasons, testing::Contains(HasSubstr("the control point at ")));
}

// The points are in the photograph's pixels, whatever size it is registered at.
TEST(RegisterPhotograph, PointsFollowThePhotographWhenItIsReduced) {
  const PolygonModel model = MakeHouse();
  const Camera truth = CameraFromTag(SlidTag(), kPhotoWidth, kPhotoHeight);
  RegisterOptions options;
  options.control_points = PointAtHouse(kCorners, 2);
  options.max_width_px = kPhotoWidth / 2;
  const Registration registration =
      RegisterPhotograph({"s1", PhotographModel(model, truth, 2, 1), {}, RememberedTag(), {}},
                         EdgeModel(model),
                         options);
  EXPECT_LT(VertexErrorPx(model, truth, registration.CorrectedCamera()), 1.0);
}

}  // namespace
}  // namespace groundglass
