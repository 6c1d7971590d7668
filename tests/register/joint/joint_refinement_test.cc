// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/joint_refinement.h"

#include "register/refine_set.h"
#include "tests/register/photographs_of_house.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

TEST(RefineTogether, AnEdgeThatThePlanHasTooLowIsFoundAndDragsNoCamera) {
  const PolygonModel plan = MakeHouse();
  const PolygonModel built = WithAHigherShed(plan);
  const EdgeModel edge_model(plan);
  std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(built, edge_model);
  for (const PhotographAlignment& alignment : alignments) {
    ASSERT_EQ(alignment.registration.verdict, Verdict::kAccepted) << alignment.registration.name;
  }
  const double alone_px = MeanVertexErrorOfHousePx(built, alignments);
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, {}, alignments);
  EXPECT_LT(MeanVertexErrorOfHousePx(built, alignments), 0.8 * alone_px);

  int num_shed = 0;
  for (const EdgeDisplacement& found : displacements) {
    const ModelEdge& edge = edge_model.edges[found.edge];
    const double up = (found.start_in_world.z() + found.end_in_world.z()) / 2;
    const bool is_eave = edge.start_in_world.z() == 8 && edge.end_in_world.z() == 8;
    if (is_eave && found.photographs.size() >= 3 && edge.start_in_world.y() < -1 &&
        edge.end_in_world.y() < -1) {
      ++num_shed;
      EXPECT_NEAR(up, 0.3, 0.06);
      EXPECT_LT(std::sqrt(found.covariance(2, 2)), 0.06);
    }
  }
  EXPECT_EQ(num_shed, 1);  // the long eave, in front

  // The list of what is off holds eaves of the lean-to and nothing else.
  const std::vector<ModelError> errors =
      FindModelErrors(edge_model, displacements, {"s1", "s2", "s3", "s4"}, {});
  ASSERT_FALSE(errors.empty());
  for (const ModelError& error : errors) {
    EXPECT_EQ(error.start_in_world.z(), 8) << error.name;
    EXPECT_NEAR(error.offset_in_world.z(), 0.3, 0.06) << error.name;
    EXPECT_GE(error.photographs.size(), 3u);
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
  std::vector<PhotographAlignment> each_edge = AlignPhotographsOfHouse(built, edge_model);
  std::vector<PhotographAlignment> as_groups = each_edge;
  RegisterOptions options;
  options.joint.most_groups = 0;
  RefineSet(edge_model, options, each_edge);
  options.joint.most_groups = 200;
  options.joint.least_edges_of_group = 2;
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, options, as_groups);
  EXPECT_LT(MeanVertexErrorOfHousePx(built, as_groups),
            0.9 * MeanVertexErrorOfHousePx(built, each_edge));
  int num_east = 0;
  for (const EdgeDisplacement& found : displacements) {
    const ModelEdge& edge = edge_model.edges[found.edge];
    if (edge.start_in_world.x() != 40 || edge.end_in_world.x() != 40) continue;
    if (found.photographs.size() < 3) continue;
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
  std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(InALawn(model), edge_model);
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, {}, alignments);
  EXPECT_LT(MeanVertexErrorOfHousePx(model, alignments), 0.35);
  int num_ground = 0;
  for (const EdgeDisplacement& found : displacements) {
    if (!edge_model.tolerances[found.edge].on_ground || found.photographs.size() < 2) continue;
    ++num_ground;
    EXPECT_NEAR(found.start_in_world.z(), 0.4, 0.1);
    EXPECT_EQ(found.start_in_world, found.end_in_world);
  }
  EXPECT_GE(num_ground, 2);
}

TEST(RefineTogether, WithAnExactModelCamerasStayAndTruthLiesInTheirEllipsoids) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(model, edge_model);
  RefineSet(edge_model, {}, alignments);
  EXPECT_LT(MeanVertexErrorOfHousePx(model, alignments), 0.35);
  for (size_t i = 0; i < alignments.size(); ++i) {
    const Registration& registration = alignments[i].registration;
    EXPECT_EQ(registration.verdict, Verdict::kAccepted);
    CameraParameters difference =
        ParametersFromTag(TrueTagsOfHouse()[i]) - ParametersFromTag(registration.corrected);
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
  std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(built, edge_model);
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
        PhotographModel(
            built, CameraFromTag(TrueTagsOfHouse()[i], kPhotoWidth, kPhotoHeight), 2, i + 1),
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
  std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(model, edge_model);
  const std::vector<EdgeDisplacement> displacements = RefineSet(edge_model, {}, alignments);
  EXPECT_FALSE(displacements.empty());
  EXPECT_TRUE(FindModelErrors(edge_model, displacements, {"s1", "s2", "s3", "s4"}, {}).empty());
}

TEST(RefineTogether, PhotographsOfOneLensEndWithOneK1) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(model, edge_model);
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
    std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(model, edge_model);
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
    const Image8 photograph = PhotographModel(
        model, CameraFromTag(TrueTagsOfHouse()[i], kPhotoWidth, kPhotoHeight), 2, i + 1);
    alignments.push_back(
        AlignPhotograph({"s" + std::to_string(i), photograph, {}, MeasuredTagsOfHouse()[i], {}},
                        edge_model,
                        options));
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
  std::vector<PhotographAlignment> alignments = AlignPhotographsOfHouse(model, edge_model);
  for (size_t i = 1; i < alignments.size(); ++i) {
    alignments[i].registration.verdict = Verdict::kReview;
  }
  const ViewTag before = alignments[0].registration.corrected;
  EXPECT_TRUE(RefineSet(edge_model, {}, alignments).empty());
  EXPECT_EQ(alignments[0].registration.corrected, before);
}

}  // namespace
}  // namespace groundglass
