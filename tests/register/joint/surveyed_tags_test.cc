// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine_set.h"
#include "register/surveyed_tags_in_set.h"
#include "tests/register/photographs_of_house.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

// Three AprilTags of 2 ft on the house's south side, as the true cameras see them; the survey errs
// by its sigma.
std::vector<SeenTagCorner> SurveyedTags(double survey_sigma) {
  constexpr double kSigmaPx = 0.1;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<SeenTagCorner> corners;
  for (int tag = 0; tag < 3; ++tag) {
    const Eigen::Vector3d middle(4 + 14 * tag, -0.1, 5 + 6 * (tag % 2));
    const Eigen::Vector3d off =
        survey_sigma * Eigen::Vector3d(normal(random), normal(random), normal(random));
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d at =
          middle + Eigen::Vector3d(corner % 3 == 0 ? -1 : 1, 0, corner < 2 ? 1 : -1);
      for (size_t i = 0; i < TrueTagsOfHouse().size(); ++i) {
        const auto seen =
            Project(CameraFromTag(TrueTagsOfHouse()[i], kPhotoWidth, kPhotoHeight), at);
        if (!seen) continue;
        corners.push_back({"s" + std::to_string(i + 1),
                           tag,
                           corner,
                           *seen + kSigmaPx * Eigen::Vector2d(normal(random), normal(random)),
                           kSigmaPx,
                           at + off,
                           survey_sigma});
      }
    }
  }
  return corners;
}

double MeanSigmaOfPosition(const std::vector<PhotographAlignment>& alignments) {
  double sum = 0;
  for (const PhotographAlignment& alignment : alignments) {
    sum += alignment.registration.sigmas.head<3>().norm();
  }
  return sum / static_cast<double>(alignments.size());
}

// The house as the surveyor finds it: all of it lies beside where the plan has it, which no
// photograph of it can tell.
PolygonModel BesideItsPlace(PolygonModel model) {
  for (Eigen::Vector3d& point : model.points_in_world) point += Eigen::Vector3d(0.15, 0.1, 0.05);
  return model;
}

TEST(RefineTogether, SurveyedAprilTagsHoldCamerasAndAMovedOneIsNamedAndPullsNone) {
  const PolygonModel plan = MakeHouse();
  const EdgeModel edge_model(plan);
  const PolygonModel built = BesideItsPlace(WithAHigherShed(plan));
  const std::vector<PhotographAlignment> alone = AlignPhotographsOfHouse(built, edge_model);
  std::vector<PhotographAlignment> without = alone;
  RefineSet(edge_model, {}, without);
  const double without_px = MeanVertexErrorOfHousePx(built, without);

  std::vector<SeenTagCorner> corners = SurveyedTags(0.01);
  std::vector<PhotographAlignment> with = alone;
  std::vector<MovedTag> moved;
  RefineSet(edge_model, {}, with, corners, &moved);
  EXPECT_TRUE(moved.empty());
  const double with_px = MeanVertexErrorOfHousePx(built, with);
  EXPECT_LT(with_px, without_px);
  EXPECT_LT(MeanSigmaOfPosition(with), MeanSigmaOfPosition(without));
  for (size_t i = 0; i < with.size(); ++i) {
    CameraParameters difference =
        ParametersFromTag(TrueTagsOfHouse()[i]) - ParametersFromTag(with[i].registration.corrected);
    difference[3] = std::remainder(difference[3], 360.0);
    EXPECT_LT(
        difference.dot(
            with[i].registration.covariance.completeOrthogonalDecomposition().solve(difference)),
        19.68);  // chi-squared, 11 degrees of freedom, 95 %
  }

  // One of them was hung elsewhere after the survey.
  for (SeenTagCorner& corner : corners) {
    if (corner.april_tag == 1) corner.surveyed_in_world += Eigen::Vector3d(1.2, 0.2, -1.1);
  }
  std::vector<PhotographAlignment> misled = alone;
  RefineSet(edge_model, {}, misled, corners, &moved);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].april_tag, 1);
  EXPECT_NEAR(moved[0].move_in_world.norm(), 1.64, 0.2);
  EXPECT_EQ(moved[0].photographs.size(), 4U);
  for (const PhotographAlignment& alignment : misled) {
    EXPECT_EQ(alignment.registration.verdict, Verdict::kAccepted) << alignment.registration.name;
  }
  EXPECT_LT(MeanVertexErrorOfHousePx(built, misled), without_px + 0.02);
  RecordProperty("without_px", std::to_string(without_px));
  RecordProperty("with_px", std::to_string(with_px));
  RecordProperty("misled_px", std::to_string(MeanVertexErrorOfHousePx(built, misled)));
}

TEST(TagCorners, BecomePointsInThePixelsOfThePictureThatIsRefined) {
  const std::vector<SeenTagCorner> corners = {{"b", 7, 2, {100, 50}, 0.2, {1, 2, 3}, 0.05},
                                              {"elsewhere", 7, 2, {0, 0}, 0.2, {1, 2, 3}, 0.05}};
  std::vector<TiePoint> ties;
  AddTagCorners(corners, {{"a", 1}, {"b", 0.5}}, {}, ties);
  ASSERT_EQ(ties.size(), 1U);
  ASSERT_EQ(ties[0].observations.size(), 1U);
  EXPECT_EQ(ties[0].observations[0].photograph, 1);
  EXPECT_EQ(ties[0].observations[0].image_px, Eigen::Vector2d(50, 25));
  EXPECT_DOUBLE_EQ(ties[0].observations[0].root_precision(0, 0), 10);
  EXPECT_DOUBLE_EQ(ties[0].survey_sigma, 0.1);  // four corners share one error of 0.05
  const auto moved = FindMovedTags(ties, {Eigen::Vector3d(0, 0, 0.3)}, {{"a", 1}, {"b", 0.5}}, {});
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(
      DescribeMovedTag(moved[0], "ft"),
      "AprilTag 7 hangs 0.3 ft from where apriltags.csv has it (sigma 0.05), as b shows it: "
      "measure it again, or take its line out and run `groundglass calibrate tags` once more");
}

}  // namespace
}  // namespace groundglass
