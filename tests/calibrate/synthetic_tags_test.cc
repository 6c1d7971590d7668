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

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace groundglass {
namespace {

using testing::HasSubstr;

constexpr double kSigmaViewAngle_deg = 0.3;
constexpr double kSigmaShift = 0.003;
constexpr double kSigmaK1 = 0.005;
constexpr double kSigmaAspect = 0.001;

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
  lens.sigmas.aspect = kSigmaAspect;
  return lens;
}

struct Misses {
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
  double MeanSquare() const { return squares / num_numbers; }
};

struct Told {
  int num_found = 0;
  Misses places;
  Misses heights;

  void Add(const PhotographPlan& plan, const TagsResult& found) {
    if (!found.is_found) return;
    ++num_found;
    EXPECT_LT(found.rms_px, 1) << plan.name;
    const Eigen::Vector3d off =
        found.tag.position_in_site - SiteFromWorld(plan.camera.PositionInWorld());
    places.Add(off.x() / *found.tag.sigmas.position);
    places.Add(off.y() / *found.tag.sigmas.position);
    heights.Add(off.z() / *found.tag.sigmas.height);
  }
};

TEST(SyntheticTags, TwentyPhotographsTellTheirStandpointsWithinTheirDeviations) {
  const TemporaryFolder folder;
  const SynthRecipe recipe = RecipeWithTags();
  EXPECT_GE(WriteSyntheticScene(recipe, folder / "scene").num_april_tags, 8);
  const auto survey = ReadSurveyedTags(folder / "scene/apriltags.csv", LengthUnit::kFoot);
  const PlannedScene planned = PlanScene(recipe);
  std::mt19937_64 random(11);
  Told by_tags;
  Told by_written;
  for (const PhotographPlan& plan : planned.photographs) {
    const Image8 grey = ReadGrey8(folder / "scene/images" / PictureFileName(plan, recipe));
    const ViewTag lens = LensAsKnown(plan, random);
    by_tags.Add(plan, CalibrateTags(grey, survey, lens));
    by_written.Add(plan,
                   CalibrateTags(grey,
                                 survey,
                                 lens,
                                 {},
                                 WrittenPlace{plan.entry.measured.position_in_site,
                                              recipe.notebook.sigma_position}));
  }
  EXPECT_GE(by_tags.num_found, 12);
  // A notebook tells which of two ways a single tag faces.
  EXPECT_GE(by_written.num_found, by_tags.num_found + 2);
  for (const auto& [told, name] : {std::pair(by_tags, "by_tags"), {by_written, "by_written"}}) {
    EXPECT_LT(told.places.worst, 4) << name;
    EXPECT_LT(told.heights.worst, 4) << name;
    EXPECT_LE(told.places.num_beyond_two + told.heights.num_beyond_two, 4) << name;
    // sigma_position is that of the worse of the two axes, so a mean square below 1 is honest.
    EXPECT_LT(told.places.MeanSquare(), 2) << name;
    EXPECT_LT(told.heights.MeanSquare(), 2) << name;
    // Nor are the claims too wide. Heights are few, and share the survey's errors; so all together.
    EXPECT_GT((told.places.squares + told.heights.squares) /
                  (told.places.num_numbers + told.heights.num_numbers),
              0.2)
        << name;
    RecordProperty(name + std::string("_found"), told.num_found);
    RecordProperty(name + std::string("_place_mean_square"),
                   std::to_string(told.places.MeanSquare()));
    RecordProperty(name + std::string("_height_mean_square"),
                   std::to_string(told.heights.MeanSquare()));
    RecordProperty(name + std::string("_worst"),
                   std::to_string(std::max(told.places.worst, told.heights.worst)));
  }
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
