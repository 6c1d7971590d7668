// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/pin_solver.h"

#include "register/register.h"
#include "session/pin_cost.h"
#include "tests/register/house.h"
#include "tests/support/spoilt_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

constexpr int kWidth = 600;
constexpr int kHeight = 400;

ViewTag TrueTag() {
  ViewTag tag;
  tag.position_in_site = {62, 48, 5};
  tag.lookat_in_site = {20, -4, 11};
  tag.aspect = 1.5;
  tag.view_angle_deg = 47;
  tag.roll_deg = 0.7;
  tag.shift_x = 0.008;
  return tag;
}

// Corners of the house that this camera sees.
const std::vector<Eigen::Vector3d> kCorners = {{0, 0, 0},
                                               {40, 0, 16},
                                               {40, 10, 24},
                                               {40, 20, 0},
                                               {0, 0, 16},
                                               {40, 0, 0},
                                               {0, 10, 24},
                                               {40, 20, 16}};

// The first so many of them, pointed at with this error.
Pins PointAt(const ViewTag& truth, int count, double error_px, uint64_t seed = 3) {
  const Camera camera = CameraFromTag(truth, kWidth, kHeight);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, 1);
  Pins pins;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d pointing(error_px * normal(random), error_px * normal(random));
    pins.points.push_back(
        {kCorners[i], *Project(camera, kCorners[i]) + pointing, std::max(error_px, 0.5)});
  }
  return pins;
}

// As somebody clicks on a plan: 10 feet off, and looking past the house.
ViewTag Rough(bool is_cropped = false) {
  return RoughTag({70, -55, 6}, {14, 2, 8}, kWidth, kHeight, is_cropped);
}

PinSolution Solve(const ViewTag& tag, const Pins& pins) {
  return SolvePins(tag, std::nullopt, kWidth, kHeight, LengthUnit::kFoot, std::nullopt, pins);
}

double ErrorPx(const ViewTag& truth, const PinSolution& solution) {
  return VertexErrorPx(MakeHouse(),
                       CameraFromTag(truth, kWidth, kHeight),
                       CameraFromTag(solution.tag, kWidth, kHeight));
}

TEST(PinSolver, EightPinsFindARoughlyPlacedCameraOfAnUnknownLens) {
  const PinSolution solution = Solve(Rough(), PointAt(TrueTag(), 8, 0));
  ASSERT_TRUE(solution.is_solved) << solution.fault;
  EXPECT_LT(ErrorPx(TrueTag(), solution), 0.5);
  EXPECT_NEAR(solution.tag.view_angle_deg, 47, 0.5);
  EXPECT_TRUE(solution.is_free[kPositionX]);
  EXPECT_TRUE(solution.is_free[kViewAngle]);
}

TEST(PinSolver, APictureThatWasCutHasItsMiddleElsewhere) {
  ViewTag cut = TrueTag();
  cut.shift_x = -0.22;
  cut.shift_y = 0.12;
  const Pins pins = PointAt(cut, 8, 0);
  EXPECT_LT(ErrorPx(cut, Solve(Rough(true), pins)), 0.5);
  EXPECT_TRUE(Solve(Rough(true), pins).is_free[kShiftX]);
  // A whole frame's middle is known better than that, and pins cannot all be met.
  EXPECT_GT(Solve(Rough(false), pins).rms_px, 2 * Solve(Rough(true), pins).rms_px);
}

TEST(PinSolver, OnePinAimsAndTwoAreMet) {
  const Pins one = PointAt(TrueTag(), 1, 0);
  const PinSolution aimed = Solve(Rough(), one);
  ASSERT_TRUE(aimed.is_solved);
  EXPECT_LT(aimed.points[0].size_px, 0.5);
  EXPECT_NEAR((aimed.tag.position_in_site - Rough().position_in_site).norm(), 0, 1e-6);
  const PinSolution two = Solve(Rough(), PointAt(TrueTag(), 2, 0));
  ASSERT_TRUE(two.is_solved);
  EXPECT_LT(two.rms_px, 1);
  EXPECT_GT((two.tag.position_in_site - Rough().position_in_site).norm(), 0.1);
  EXPECT_NEAR(two.tag.view_angle_deg, Rough().view_angle_deg, 1e-9);
  EXPECT_FALSE(two.is_free[kViewAngle]);
}

TEST(PinSolver, DeviationsHoldOverManyPointings) {
  // Squared errors of the position in units of what is claimed are about 1.
  constexpr int kTrials = 60;
  double sum = 0;
  for (int i = 0; i < kTrials; ++i) {
    ViewTag prior = TrueTag();
    std::mt19937_64 random(100 + i);
    std::normal_distribution<double> normal(0, 1);
    prior.sigmas.position = 3;
    prior.sigmas.height = 1;
    prior.sigmas.lookat = 3;
    prior.position_in_site +=
        Eigen::Vector3d(3 * normal(random), 3 * normal(random), normal(random));
    prior.lookat_in_site += 3 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    const PinSolution solution = Solve(prior, PointAt(TrueTag(), 8, 1, 500 + i));
    const CameraParameters error = solution.parameters - ParametersFromTag(TrueTag());
    for (const int parameter : {kPositionX, kPositionY, kPositionZ}) {
      sum += std::pow(error[parameter] / solution.sigmas[parameter], 2) / (3 * kTrials);
    }
  }
  EXPECT_GT(sum, 0.6);
  EXPECT_LT(sum, 1.5);
}

TEST(PinSolver, TheBadPinIsNamed) {
  Pins pins = PointAt(TrueTag(), 8, 0.5);
  pins.points[3].image_px += Eigen::Vector2d(14, -9);
  const PinSolution solution = Solve(Rough(), pins);
  ASSERT_TRUE(solution.worst);
  EXPECT_EQ(*solution.worst, 3);
  // Without a say it is still measured, and spoils nothing.
  pins.points[3].use = PinUse::kCheck;
  const PinSolution without = Solve(Rough(), pins);
  EXPECT_EQ(without.worst, std::optional<int>(3));
  EXPECT_NEAR(without.points[3].size_px, std::hypot(14, 9), 3);
  EXPECT_LT(without.rms_px, 1);
  pins.points[3].use = PinUse::kOff;
  EXPECT_FALSE(Solve(Rough(), pins).worst);
}

TEST(PinSolver, LinesHoldWhatPointsLeaveOpen) {
  const Camera camera = CameraFromTag(TrueTag(), kWidth, kHeight);
  Pins pins = PointAt(TrueTag(), 3, 0);
  const double with_points = ErrorPx(TrueTag(), Solve(Rough(), pins));
  // Each line is drawn over a part of the edge's image only.
  const auto add = [&](const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
    const Eigen::Vector2d a = *Project(camera, start);
    const Eigen::Vector2d b = *Project(camera, end);
    pins.lines.push_back({start, end, a + 0.3 * (b - a), a + 0.8 * (b - a), 0.5, PinUse::kUsed});
  };
  add({40, 0, 0}, {40, 0, 16});
  add({0, 0, 0}, {0, 0, 16});
  add({0, 10, 24}, {40, 10, 24});
  add({0, 0, 0}, {40, 0, 0});
  const PinSolution solution = Solve(Rough(), pins);
  ASSERT_TRUE(solution.is_solved);
  EXPECT_LT(solution.lines[0].size_px, 0.2);
  EXPECT_LT(ErrorPx(TrueTag(), solution), with_points);
}

TEST(PinSolver, APinBehindTheCameraIsAFaultAndNoCrash) {
  Pins pins;
  pins.points.push_back({{70, 55, 6}, {300, 200}, 2, PinUse::kUsed});
  pins.points.push_back({{500, 500, 6}, {300, 200}, 2, PinUse::kUsed});
  pins.points.push_back({{-500, -900, 6}, {100, 200}, 2, PinUse::kUsed});
  const PinSolution solution = Solve(Rough(), pins);
  if (!solution.is_solved) {
    EXPECT_THAT(solution.fault, testing::HasSubstr("in front"));
  }
  EXPECT_TRUE(ParametersFromTag(solution.tag).allFinite());
}

TEST(PinSolver, TheLinesDerivativesAreThoseOfDifferences) {
  const CameraParameters parameters = ParametersFromTag(TrueTag());
  const LinePin pin = {{40, 0, 0}, {40, 0, 16}, {310, 180}, {330, 260}, 1, PinUse::kUsed};
  const auto measure = [&](const CameraParameters& at) {
    return *MeasureLine(pin, ParameterProjection(at, TagDistortion(TrueTag()), kWidth, kHeight));
  };
  const LineDistances measured = measure(parameters);
  for (int i = 0; i < kNumCameraParameters; ++i) {
    CameraParameters step = CameraParameters::Zero();
    step[i] = 1e-5;
    const Eigen::Vector2d by_difference =
        (measure(parameters + step).distances_px - measure(parameters - step).distances_px) / 2e-5;
    EXPECT_NEAR((measured.jacobian.col(i) - by_difference).norm(),
                0,
                1e-4 * std::max(1.0, by_difference.norm()))
        << kCameraParameterNames[i];
  }
}

TEST(PinSolver, WhatIsSavedSaysHowSureItIs) {
  const PinSolution solution = Solve(Rough(), PointAt(TrueTag(), 8, 1));
  const ViewTag saved = TagToSave(solution);
  EXPECT_FALSE(FindTagFault(saved));
  EXPECT_DOUBLE_EQ(*saved.sigmas.position,
                   std::max(solution.sigmas[kPositionX], solution.sigmas[kPositionY]));
  EXPECT_LT(*saved.sigmas.position, *Rough().sigmas.position);
  EXPECT_GT(*saved.sigmas.lookat, 0);
}

TEST(PinSolver, OptionsAreChecked) {
  ExpectCheckNamesEach<PinSolverOptions>(
      {{"max_iterations", [](PinSolverOptions& o) { o.max_iterations = 0; }},
       {"bad_pin_sigmas", [](PinSolverOptions& o) { o.bad_pin_sigmas = 0; }},
       {"free_share", [](PinSolverOptions& o) { o.free_share = 2; }}});
  ExpectCheckNamesEach<RoughPlaceOptions>(
      {{"position_share", [](RoughPlaceOptions& o) { o.position_share = 0; }},
       {"height_share", [](RoughPlaceOptions& o) { o.height_share = kNotANumber; }},
       {"lookat_share", [](RoughPlaceOptions& o) { o.lookat_share = -1; }},
       {"roll_deg", [](RoughPlaceOptions& o) { o.roll_deg = 0; }},
       {"view_angle_deg", [](RoughPlaceOptions& o) { o.view_angle_deg = 180; }},
       {"view_angle_sigma_deg", [](RoughPlaceOptions& o) { o.view_angle_sigma_deg = 0; }},
       {"shift", [](RoughPlaceOptions& o) { o.shift = 0; }},
       {"cropped_shift", [](RoughPlaceOptions& o) { o.cropped_shift = 0; }}});
}

}  // namespace
}  // namespace groundglass
