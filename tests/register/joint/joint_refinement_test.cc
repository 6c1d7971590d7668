// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/joint_refinement.h"

#include "register/refine_set.h"
#include "register/surveyed_tags_in_set.h"
#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace groundglass {
namespace {

ViewTag TagAt(double x, double y, double z, double i, double j, double k) {
  ViewTag tag;
  tag.position_in_site = {x, y, z};
  tag.lookat_in_site = {i, j, k};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  return tag;
}

// Four cameras on the house's south side: `site` counts y southwards.
std::vector<ViewTag> TrueTags() {
  return {TagAt(-20, 55, 6, 18, -6, 9),
          TagAt(8, 62, 5, 20, -8, 9),
          TagAt(38, 60, 7, 20, -8, 10),
          TagAt(66, 45, 6, 24, -6, 9)};
}

// The tags as a tape has them.
std::vector<ViewTag> MeasuredTags() {
  std::vector<ViewTag> tags = TrueTags();
  const Eigen::Vector3d errors[] = {
      {0.3, -0.2, 0.1}, {-0.25, 0.3, -0.1}, {0.2, 0.25, 0.05}, {-0.3, -0.1, 0.1}};
  for (size_t i = 0; i < tags.size(); ++i) {
    tags[i].position_in_site += errors[i];
    tags[i].lookat_in_site -= errors[3 - i];
  }
  return tags;
}

std::vector<PhotographAlignment> AlignAll(const PolygonModel& built, const EdgeModel& edge_model) {
  std::vector<PhotographAlignment> alignments;
  const std::vector<ViewTag> truth = TrueTags();
  const std::vector<ViewTag> measured = MeasuredTags();
  for (size_t i = 0; i < truth.size(); ++i) {
    const Image8 photograph =
        PhotographModel(built, CameraFromTag(truth[i], kPhotoWidth, kPhotoHeight), 2, i + 1);
    alignments.push_back(AlignPhotograph(
        {"s" + std::to_string(i + 1), photograph, {}, measured[i], {}}, edge_model, {}));
  }
  return alignments;
}

double MeanVertexErrorPx(const PolygonModel& model,
                         const std::vector<PhotographAlignment>& alignments) {
  double sum = 0;
  for (size_t i = 0; i < alignments.size(); ++i) {
    sum += VertexErrorPx(model,
                         CameraFromTag(TrueTags()[i], kPhotoWidth, kPhotoHeight),
                         alignments[i].registration.CorrectedCamera());
  }
  return sum / static_cast<double>(alignments.size());
}

// The house as built: its lean-to is 0.3 ft higher than in the plan.
PolygonModel WithAHigherShed(PolygonModel model) {
  for (Eigen::Vector3d& point : model.points_in_world) {
    if (point.z() == 8) point.z() += 0.3;
  }
  return model;
}

TEST(RefineTogether, AnEdgeThatThePlanHasTooLowIsFoundAndDragsNoCamera) {
  const PolygonModel plan = MakeHouse();
  const PolygonModel built = WithAHigherShed(plan);
  const EdgeModel edge_model(plan);
  std::vector<PhotographAlignment> alignments = AlignAll(built, edge_model);
  for (const PhotographAlignment& alignment : alignments) {
    ASSERT_EQ(alignment.registration.verdict, Verdict::kAccepted) << alignment.registration.name;
  }
  const double alone_px = MeanVertexErrorPx(built, alignments);
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, {}, alignments);
  EXPECT_LT(MeanVertexErrorPx(built, alignments), 0.8 * alone_px);

  int num_shed = 0;
  for (const EdgeDisplacement& found : displacements) {
    const ModelEdge& edge = edge_model.edges[found.edge];
    const double up = (found.start_in_world.z() + found.end_in_world.z()) / 2;
    const bool is_eave = edge.start_in_world.z() == 8 && edge.end_in_world.z() == 8;
    if (is_eave && found.num_photographs >= 3 && edge.start_in_world.y() < -1 &&
        edge.end_in_world.y() < -1) {
      ++num_shed;
      EXPECT_NEAR(up, 0.3, 0.06);
      EXPECT_LT(std::sqrt(found.covariance(2, 2)), 0.06);
    }
  }
  EXPECT_EQ(num_shed, 1);  // the long eave, in front

  // The list of what is off holds eaves of the lean-to and nothing else.
  const std::vector<ModelError> errors = FindModelErrors(edge_model, displacements, {});
  ASSERT_FALSE(errors.empty());
  for (const ModelError& error : errors) {
    EXPECT_EQ(error.start_in_world.z(), 8) << error.name;
    EXPECT_NEAR(error.offset_in_world.z(), 0.3, 0.06) << error.name;
    EXPECT_GE(error.num_photographs, 3);
    EXPECT_GT(error.sigma, 0);
  }
}

// The house as built: its east end, with all that ends there, is 0.5 ft further east.
PolygonModel WithAnEndFurtherOut(PolygonModel model) {
  for (Eigen::Vector3d& point : model.points_in_world) {
    if (point.x() == 40) point.x() += 0.5;
  }
  return model;
}

TEST(RefineTogether, AWallThatIsOffMovesWithAllItsEdgesAndDragsNoCamera) {
  const PolygonModel plan = MakeHouse();
  const PolygonModel built = WithAnEndFurtherOut(plan);
  const EdgeModel edge_model(plan);
  std::vector<PhotographAlignment> each_edge = AlignAll(built, edge_model);
  std::vector<PhotographAlignment> as_groups = each_edge;
  RegisterOptions options;
  options.joint.most_groups = 0;
  RefineSet(edge_model, options, each_edge);
  options.joint.most_groups = 200;
  options.joint.least_edges_of_group = 2;
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, options, as_groups);
  EXPECT_LT(MeanVertexErrorPx(built, as_groups), 0.9 * MeanVertexErrorPx(built, each_edge));
  int num_east = 0;
  for (const EdgeDisplacement& found : displacements) {
    const ModelEdge& edge = edge_model.edges[found.edge];
    if (edge.start_in_world.x() != 40 || edge.end_in_world.x() != 40) continue;
    if (found.num_photographs < 3) continue;
    ++num_east;
    EXPECT_NEAR(found.start_in_world.x(), 0.5, 0.15) << found.edge;
  }
  EXPECT_GE(num_east, 1);
}

// The house as it stands in its garden: a lawn 0.4 ft above the plan's ground hides the foot of
// every wall.
PolygonModel InALawn(PolygonModel model) {
  const auto first = static_cast<int>(model.points_in_world.size());
  for (const auto& [x, y] :
       {std::pair(-60.0, -60.0), {100.0, -60.0}, {100.0, 80.0}, {-60.0, 80.0}}) {
    model.points_in_world.push_back({x, y, 0.4});
  }
  model.faces.push_back({{first, first + 1, first + 2, first + 3}, "lawn"});
  return model;
}

TEST(RefineTogether, ALawnThatHidesTheFootOfAllWallsDragsNoCamera) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments = AlignAll(InALawn(model), edge_model);
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, {}, alignments);
  EXPECT_LT(MeanVertexErrorPx(model, alignments), 0.35);
  int num_ground = 0;
  for (const EdgeDisplacement& found : displacements) {
    if (!edge_model.tolerances[found.edge].on_ground || found.num_photographs < 2) continue;
    ++num_ground;
    EXPECT_NEAR(found.start_in_world.z(), 0.4, 0.1);
    EXPECT_EQ(found.start_in_world, found.end_in_world);
  }
  EXPECT_GE(num_ground, 2);
}

TEST(RefineTogether, WithAnExactModelCamerasStayAndTruthLiesInTheirEllipsoids) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments = AlignAll(model, edge_model);
  RefineSet(edge_model, {}, alignments);
  EXPECT_LT(MeanVertexErrorPx(model, alignments), 0.35);
  for (size_t i = 0; i < alignments.size(); ++i) {
    const Registration& registration = alignments[i].registration;
    EXPECT_EQ(registration.verdict, Verdict::kAccepted);
    CameraParameters difference =
        ParametersFromTag(TrueTags()[i]) - ParametersFromTag(registration.corrected);
    difference[3] = std::remainder(difference[3], 360.0);
    const double squared =
        difference.dot(registration.covariance.completeOrthogonalDecomposition().solve(difference));
    EXPECT_LT(squared, 19.68) << registration.name;  // chi-squared, 11 degrees of freedom, 95 %
  }
}

// Each photograph is scored again by the camera that is written, not by the one that it found
// alone; with groups of edges where they are found, which no camera has to make up for.
TEST(RefineSet, TheScoreIsThatOfTheCameraThatIsWritten) {
  const PolygonModel plan = MakeHouse();
  const PolygonModel built = WithAHigherShed(plan);
  const EdgeModel edge_model(plan);
  std::vector<PhotographAlignment> alignments = AlignAll(built, edge_model);
  std::vector<double> alone;
  for (const PhotographAlignment& alignment : alignments) {
    alone.push_back(alignment.registration.score_nats);
  }
  std::vector<PhotographAlignment> with_groups = alignments;
  RefineSet(edge_model, {}, with_groups);
  RegisterOptions options;
  options.joint.most_groups = 0;
  RefineSet(edge_model, options, alignments);
  for (size_t i = 0; i < alignments.size(); ++i) {
    const Registration& registration = alignments[i].registration;
    EXPECT_GT(with_groups[i].registration.score_nats, registration.score_nats);
    const EdgeEvidence evidence(
        PhotographModel(built, CameraFromTag(TrueTags()[i], kPhotoWidth, kPhotoHeight), 2, i + 1),
        {});
    const AlignmentScore score = ScoreAlignment(
        SampleVisibleEdges(edge_model, registration.CorrectedCamera(), -3, 4),
        ParameterProjection(
            ParametersFromTag(registration.corrected), {}, kPhotoWidth, kPhotoHeight),
        evidence,
        {});
    EXPECT_NE(registration.score_nats, alone[i]);
    EXPECT_NEAR(registration.score_nats, score.nats, 0.03 * score.nats);
  }
}

TEST(FindModelErrors, AnExactModelHasNone) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments = AlignAll(model, edge_model);
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, {}, alignments);
  EXPECT_FALSE(displacements.empty());
  EXPECT_TRUE(FindModelErrors(edge_model, displacements, {}).empty());
}

TEST(RefineTogether, PhotographsOfOneLensEndWithOneK1) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments = AlignAll(model, edge_model);
  double spread_alone = 0;
  for (const PhotographAlignment& alignment : alignments) {
    spread_alone = std::max(
        spread_alone,
        std::abs(alignment.registration.corrected.k1 - alignments[0].registration.corrected.k1));
  }
  RefineSet(edge_model, {}, alignments);
  double spread = 0;
  for (const PhotographAlignment& alignment : alignments) {
    spread = std::max(
        spread,
        std::abs(alignment.registration.corrected.k1 - alignments[0].registration.corrected.k1));
  }
  EXPECT_LT(spread, 0.001);
  EXPECT_GT(spread_alone, 3 * spread);
}

TEST(RefineSet, DigitalPhotographsOfOneLensEndWithOneViewAngleAndAspect) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  for (const bool digital : {false, true}) {
    RegisterOptions options;
    options.prior.digital = digital;
    std::vector<PhotographAlignment> alignments = AlignAll(model, edge_model);
    RefineSet(edge_model, options, alignments);
    double view_angle_spread_deg = 0;
    double aspect_spread = 0;
    double shift_spread = 0;
    const ViewTag& first = alignments[0].registration.corrected;
    for (const PhotographAlignment& alignment : alignments) {
      const ViewTag& tag = alignment.registration.corrected;
      view_angle_spread_deg =
          std::max(view_angle_spread_deg, std::abs(tag.view_angle_deg - first.view_angle_deg));
      aspect_spread = std::max(aspect_spread, std::abs(tag.aspect - first.aspect));
      shift_spread = std::max({shift_spread,
                               std::abs(tag.shift_x - first.shift_x),
                               std::abs(tag.shift_y - first.shift_y)});
    }
    EXPECT_EQ(view_angle_spread_deg < 0.02, digital) << view_angle_spread_deg;
    EXPECT_EQ(aspect_spread < 0.0005, digital) << aspect_spread;
    EXPECT_EQ(shift_spread < 0.0005, digital) << shift_spread;
  }
}

TEST(RefineTogether, LockedParametersStayLocked) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  RegisterOptions options;
  options.prior.lock = {"v", "a", "k1"};
  std::vector<PhotographAlignment> alignments;
  for (size_t i = 0; i < 2; ++i) {
    const Image8 photograph =
        PhotographModel(model, CameraFromTag(TrueTags()[i], kPhotoWidth, kPhotoHeight), 2, i + 1);
    alignments.push_back(AlignPhotograph(
        {"s" + std::to_string(i), photograph, {}, MeasuredTags()[i], {}}, edge_model, options));
  }
  RefineSet(edge_model, options, alignments);
  for (const PhotographAlignment& alignment : alignments) {
    EXPECT_DOUBLE_EQ(alignment.registration.corrected.view_angle_deg, 54);
    EXPECT_DOUBLE_EQ(alignment.registration.corrected.aspect, 1.5);
    EXPECT_DOUBLE_EQ(alignment.registration.corrected.k1, 0);
    EXPECT_EQ(alignment.registration.sigmas[10], 0);
  }
}

TEST(RefineSet, OnePhotographStaysAsItIs) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments = AlignAll(model, edge_model);
  for (size_t i = 1; i < alignments.size(); ++i) {
    alignments[i].registration.verdict = Verdict::kReview;
  }
  const ViewTag before = alignments[0].registration.corrected;
  EXPECT_TRUE(RefineSet(edge_model, {}, alignments).empty());
  EXPECT_EQ(alignments[0].registration.corrected, before);
}

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
      for (size_t i = 0; i < TrueTags().size(); ++i) {
        const auto seen = Project(CameraFromTag(TrueTags()[i], kPhotoWidth, kPhotoHeight), at);
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
  const std::vector<PhotographAlignment> alone = AlignAll(built, edge_model);
  std::vector<PhotographAlignment> without = alone;
  RefineSet(edge_model, {}, without);
  const double without_px = MeanVertexErrorPx(built, without);

  std::vector<SeenTagCorner> corners = SurveyedTags(0.01);
  std::vector<PhotographAlignment> with = alone;
  std::vector<MovedTag> moved;
  RefineSet(edge_model, {}, with, corners, &moved);
  EXPECT_TRUE(moved.empty());
  const double with_px = MeanVertexErrorPx(built, with);
  EXPECT_LT(with_px, without_px);
  EXPECT_LT(MeanSigmaOfPosition(with), MeanSigmaOfPosition(without));
  for (size_t i = 0; i < with.size(); ++i) {
    CameraParameters difference =
        ParametersFromTag(TrueTags()[i]) - ParametersFromTag(with[i].registration.corrected);
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
  EXPECT_LT(MeanVertexErrorPx(built, misled), without_px + 0.02);
  RecordProperty("without_px", std::to_string(without_px));
  RecordProperty("with_px", std::to_string(with_px));
  RecordProperty("misled_px", std::to_string(MeanVertexErrorPx(built, misled)));
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
