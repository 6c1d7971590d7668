// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Photographs of a synthetic building on whose walls AprilTags hang.
#include "calibrate/calibrate_tags.h"
#include "datasets-synthetic/planned_scene.h"
#include "datasets-synthetic/synth.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/frames.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

using testing::HasSubstr;

constexpr double kSigmaViewAngle_deg = 0.3;
constexpr double kSigmaShift = 0.003;
constexpr double kSigmaK1 = 0.005;

SynthRecipe RecipeWithTags() {
  SynthRecipe recipe = PresetRecipe("wiesner");
  recipe.width_px = 600;
  recipe.height_px = 400;
  recipe.num_views = 20;
  recipe.surface_texel = 5;
  recipe.slide = {kSigmaShift, 0, 0, 0, 0, 0, 0};
  recipe.photo.spoilt_share = 0;
  recipe.occluders = {};
  recipe.april_tags = {.count = 10, .size = 5, .sigma = 0.05, .least_px = 18};
  return recipe;
}

// What a photographer may know of the lens: its true numbers, each off by its standard deviation.
ViewTag LensAsKnown(const PhotographPlan& plan, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  ViewTag lens = plan.entry.measured;
  lens.view_angle_deg = plan.entry.actual.view_angle_deg + kSigmaViewAngle_deg * normal(random);
  lens.k1 = plan.entry.actual.k1 + kSigmaK1 * normal(random);
  lens.sigmas.view_angle_deg = kSigmaViewAngle_deg;
  lens.sigmas.shift = kSigmaShift;
  lens.sigmas.k1 = kSigmaK1;
  return lens;
}

struct Misses {
  int num_found = 0;
  int num_numbers = 0;
  int num_beyond_two = 0;
  double squares = 0;  // in standard deviations
  double worst = 0;

  void Add(double sigmas) {
    ++num_numbers;
    num_beyond_two += std::abs(sigmas) > 2;
    squares += sigmas * sigmas;
    worst = std::max(worst, std::abs(sigmas));
  }
};

TEST(SyntheticTags, TwentyPhotographsTellTheirStandpointsWithinTheirDeviations) {
  const TemporaryFolder folder;
  const SynthRecipe recipe = RecipeWithTags();
  EXPECT_GE(WriteSyntheticScene(recipe, folder / "scene").num_april_tags, 8);
  const auto survey = ReadSurveyedTags(folder / "scene/apriltags.csv", LengthUnit::kFoot);
  const PlannedScene planned = PlanScene(recipe);
  std::mt19937_64 random(11);
  Misses places;
  Misses heights;
  for (const PhotographPlan& plan : planned.photographs) {
    const Image8 grey = ReadGrey8(folder / "scene/images" / PictureFileName(plan, recipe));
    const TagsResult found = CalibrateTags(grey, survey, LensAsKnown(plan, random));
    if (!found.is_found) continue;
    ++places.num_found;
    EXPECT_LT(found.rms_px, 1) << plan.name;
    const Eigen::Vector3d off =
        found.tag.position_in_site - SiteFromWorld(plan.camera.PositionInWorld());
    places.Add(off.x() / *found.tag.sigmas.position);
    places.Add(off.y() / *found.tag.sigmas.position);
    heights.Add(off.z() / *found.tag.sigmas.height);
  }
  EXPECT_GE(places.num_found, 12);
  EXPECT_LT(places.worst, 4);
  EXPECT_LT(heights.worst, 4);
  EXPECT_LE(places.num_beyond_two + heights.num_beyond_two, 4);
  // sigma_position is that of the worse of the two axes, so a mean square below 1 is honest.
  const double mean_square = places.squares / places.num_numbers;
  EXPECT_LT(mean_square, 2);
  // Nor are the claims too wide. Heights are few, and share the survey's errors: 0.31 to 1.33 on
  // seeds 1, 3 and 5, 0.11 here; so all numbers together.
  EXPECT_GT((places.squares + heights.squares) / (places.num_numbers + heights.num_numbers), 0.25);
  EXPECT_LT(heights.squares / heights.num_numbers, 2);
  RecordProperty("found", places.num_found);
  RecordProperty("place_mean_square", std::to_string(mean_square));
  RecordProperty("height_mean_square", std::to_string(heights.squares / heights.num_numbers));
}

TEST(SyntheticTags, TheSurveyErrsByItsSigmaAndTheTruthDoesNot) {
  const SynthRecipe recipe = RecipeWithTags();
  const PlannedScene planned = PlanScene(recipe);
  const TemporaryFolder folder;
  const auto written = [&](bool is_truth) {
    return ReadSurveyedTags(
        folder.Write("tags.csv", FormatWallTags(planned.wall_tags, recipe.april_tags, is_truth)),
        LengthUnit::kFoot);
  };
  const auto surveyed = written(false);
  const auto truth = written(true);
  ASSERT_EQ(surveyed.size(), planned.wall_tags.size());
  double squares = 0;
  for (size_t i = 0; i < surveyed.size(); ++i) {
    const Eigen::Vector3d true_middle = truth[i].corners_in_world.rowwise().mean();
    EXPECT_LT((true_middle - planned.wall_tags[i].middle_in_world).norm(), 1e-4);
    const Eigen::Vector3d off = surveyed[i].corners_in_world.rowwise().mean() - true_middle;
    squares += off.squaredNorm() / 3 / std::pow(recipe.april_tags.sigma, 2);
    EXPECT_EQ(surveyed[i].sigma, recipe.april_tags.sigma);
  }
  EXPECT_NEAR(squares / static_cast<double>(surveyed.size()), 1, 0.8);
}

TEST(SyntheticTags, TagsThatNobodyWouldSeeAreAnError) {
  SynthRecipe recipe = RecipeWithTags();
  recipe.april_tags.least_px = 1000;
  EXPECT_THAT(ThrownMessage([&] { PlanScene(recipe); }), HasSubstr("give larger tags"));
}

}  // namespace
}  // namespace groundglass
