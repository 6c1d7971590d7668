// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine_set.h"
#include "register/register.h"
#include "scene/model_sigma.h"
#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace groundglass {
namespace {

ViewTag TagAt(const Eigen::Vector3d& position_in_site, const Eigen::Vector3d& lookat_in_site) {
  ViewTag tag;
  tag.position_in_site = position_in_site;
  tag.lookat_in_site = lookat_in_site;
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  return tag;
}

// Three cameras on the house's south side, in feet, and what a tape made of them.
std::vector<ViewTag> ThreeTrueTags() {
  return {TagAt({-20, 55, 6}, {18, -6, 9}),
          TagAt({8, 62, 5}, {20, -8, 9}),
          TagAt({66, 45, 6}, {24, -6, 9})};
}
std::vector<ViewTag> ThreeMeasuredTags() {
  std::vector<ViewTag> tags = ThreeTrueTags();
  const Eigen::Vector3d errors[] = {{0.3, -0.2, 0.1}, {-0.25, 0.3, -0.1}, {0.2, 0.25, 0.05}};
  for (size_t i = 0; i < tags.size(); ++i) {
    tags[i].position_in_site += errors[i];
    tags[i].lookat_in_site -= errors[2 - i];
  }
  return tags;
}

const std::vector<Image8>& Photographs() {
  static const std::vector<Image8> photographs = [] {
    std::vector<Image8> drawn;
    for (const ViewTag& tag : ThreeTrueTags()) {
      drawn.push_back(PhotographModel(
          MakeHouse(), CameraFromTag(tag, kPhotoWidth, kPhotoHeight), 2, drawn.size() + 1));
    }
    return drawn;
  }();
  return photographs;
}

PolygonModel ScaledHouse(double scale, LengthUnit unit, std::optional<double> sigma) {
  PolygonModel model = MakeHouse();
  for (Eigen::Vector3d& point : model.points_in_world) point *= scale;
  model.unit = unit;
  model.sigma = sigma;
  return model;
}

// The photographs registered by themselves on the house in other lengths: the same pictures,
// whatever the scale.
std::vector<PhotographAlignment> AlignScaled(double scale,
                                             LengthUnit unit,
                                             std::optional<double> sigma) {
  const PolygonModel model = ScaledHouse(scale, unit, sigma);
  const EdgeModel edge_model(model);
  std::vector<PhotographAlignment> alignments;
  for (size_t i = 0; i < Photographs().size(); ++i) {
    ViewTag tag = ThreeMeasuredTags()[i];
    tag.position_in_site *= scale;
    tag.lookat_in_site *= scale;
    alignments.push_back(
        AlignPhotograph({"s" + std::to_string(i), Photographs()[i], {}, tag, {}}, edge_model, {}));
  }
  return alignments;
}

// The same, registered together.
std::vector<PhotographAlignment> RegisterScaled(double scale,
                                                LengthUnit unit,
                                                std::optional<double> sigma) {
  std::vector<PhotographAlignment> alignments = AlignScaled(scale, unit, sigma);
  const PolygonModel model = ScaledHouse(scale, unit, sigma);
  RefineSet(EdgeModel(model), {}, alignments);
  for (PhotographAlignment& alignment : alignments) FinishVerdict({}, alignment);
  return alignments;
}

// Found, in px of the house in feet.
double ErrorPx(const PhotographAlignment& alignment, size_t photograph, double scale) {
  ViewTag found = alignment.registration.corrected;
  found.position_in_site /= scale;
  found.lookat_in_site /= scale;
  return VertexErrorPx(MakeHouse(),
                       CameraFromTag(ThreeTrueTags()[photograph], kPhotoWidth, kPhotoHeight),
                       CameraFromTag(found, kPhotoWidth, kPhotoHeight));
}

TEST(ModelTolerance, AMaquetteIsRegisteredLikeItsBuilding) {
  const std::vector<PhotographAlignment> building = RegisterScaled(1, LengthUnit::kFoot, {});
  // 1:100, 0.17 m across: in metres, and in millimetres.
  const std::pair<double, LengthUnit> maquettes[] = {{0.003048, LengthUnit::kMetre},
                                                     {3.048, LengthUnit::kMillimetre}};
  for (const auto& [scale, unit] : maquettes) {
    const std::vector<PhotographAlignment> maquette = RegisterScaled(scale, unit, {});
    for (size_t i = 0; i < maquette.size(); ++i) {
      const Registration& small = maquette[i].registration;
      EXPECT_EQ(small.verdict, Verdict::kAccepted) << UnitName(unit) << " " << small.name;
      EXPECT_EQ(small.verdict, building[i].registration.verdict);
      EXPECT_LT(ErrorPx(maquette[i], i, scale), 0.5) << UnitName(unit) << " " << small.name;
      EXPECT_NEAR(ErrorPx(maquette[i], i, scale), ErrorPx(building[i], i, 1), 0.1);
      EXPECT_NEAR(small.vertex_sigma_px,
                  building[i].registration.vertex_sigma_px,
                  0.3 * small.vertex_sigma_px);
    }
  }
}

TEST(ModelTolerance, AMaquetteOfALargeHallIsAsCertainAsTheHall) {
  // 41 m across, and 0.41 m; each photograph by itself.
  const auto vertex_sigmas = [](double scale, LengthUnit unit) {
    std::vector<double> sigmas_px;
    for (PhotographAlignment& alignment : AlignScaled(scale, unit, {})) {
      FinishVerdict({}, alignment);
      EXPECT_EQ(alignment.registration.verdict, Verdict::kAccepted) << alignment.registration.name;
      sigmas_px.push_back(alignment.registration.vertex_sigma_px);
    }
    return sigmas_px;
  };
  const std::vector<double> hall = vertex_sigmas(2.4, LengthUnit::kFoot);
  const std::vector<double> maquette = vertex_sigmas(2.4 * 0.003048, LengthUnit::kMetre);
  for (size_t i = 0; i < hall.size(); ++i) EXPECT_NEAR(maquette[i], hall[i], 0.3 * hall[i]) << i;
}

TEST(ModelTolerance, ALargerSigmaMakesEveryCameraLessCertain) {
  const double usual = DefaultModelSigma(MakeHouse());
  const std::vector<PhotographAlignment> by_default = RegisterScaled(1, LengthUnit::kFoot, {});
  const std::vector<PhotographAlignment> stated = RegisterScaled(1, LengthUnit::kFoot, usual);
  const std::vector<PhotographAlignment> wide = RegisterScaled(1, LengthUnit::kFoot, 10 * usual);
  const std::vector<PhotographAlignment> tight = RegisterScaled(1, LengthUnit::kFoot, 0.1 * usual);
  for (size_t i = 0; i < wide.size(); ++i) {
    const Registration& registration = by_default[i].registration;
    EXPECT_EQ(stated[i].registration.covariance, registration.covariance);
    EXPECT_EQ(stated[i].registration.corrected, registration.corrected);
    EXPECT_GT(wide[i].registration.vertex_sigma_px, 2 * registration.vertex_sigma_px);
    EXPECT_LT(tight[i].registration.vertex_sigma_px, registration.vertex_sigma_px);
    for (const int parameter : {0, 1, 2}) {
      EXPECT_GT(wide[i].registration.sigmas[parameter], registration.sigmas[parameter]);
    }
  }
}

TEST(ModelTolerance, ALooseModelMayLieOffAsAWholeEdgeAndStillScores) {
  // One upright edge of 80 px, seen 6 px beside where the camera has it.
  const ParameterProjection projection(
      ParametersFromTag(TagAt({0, 100, 0}, {0, 0, 0})), {}, kPhotoWidth, kPhotoHeight);
  std::vector<ScoreSample> samples;
  for (int i = 0; i < 20; ++i) {
    ScoreSample sample;
    sample.point_in_world = {0, 0, 0.1 * i};
    sample.edge = 0;
    sample.observations = 0.2;
    sample.origin_px = projection.Project(sample.point_in_world)->image_px;
    sample.range_px = 12;
    sample.candidates = {{6.2, 8}};
    samples.push_back(sample);
  }
  const double held = ScoreFromSamples(samples, projection, {}).nats;
  EXPECT_LT(held, 0);
  for (ScoreSample& sample : samples) {
    sample.loose_px = 4;
    sample.range_px = std::hypot(12, 12);
  }
  EXPECT_GT(ScoreFromSamples(samples, projection, {}).nats, 1);
  // Where nothing is to be seen, looseness does not help.
  for (ScoreSample& sample : samples) sample.candidates.clear();
  EXPECT_LT(ScoreFromSamples(samples, projection, {}).nats, 0);
}

TEST(PriorSuitedTo, LeavesATapeToBuildingsAndARulerToMaquettes) {
  PolygonModel house = MakeHouse();
  const PriorOptions at_house = PriorSuitedTo(house, {});
  EXPECT_EQ(at_house.OwnPositionMetres(), 0.076);
  EXPECT_EQ(at_house.OwnHeightMetres(), 0.030);
  EXPECT_EQ(at_house.OwnLookatMetres(), 0.122);
  // 0.3 m across: a fiftieth of 15 m, and no less than a millimetre.
  const double scale = 0.3 / ComputeBounds(house).Diagonal();
  for (Eigen::Vector3d& point : house.points_in_world) point *= scale;
  house.unit = LengthUnit::kMetre;
  PriorOptions given;
  given.lookat_m = 0.05;
  const PriorOptions at_maquette = PriorSuitedTo(house, given);
  EXPECT_NEAR(at_maquette.OwnPositionMetres(), 0.076 / 50, 1e-12);
  EXPECT_EQ(at_maquette.OwnHeightMetres(), 0.001);
  EXPECT_EQ(at_maquette.lookat_m, 0.05);  // what a person says stands
}

}  // namespace
}  // namespace groundglass
