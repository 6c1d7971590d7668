// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/measure.h"
#include "tests/ask/room_survey.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

using testing::HasSubstr;

// What the deviations claim, drawn by chance: cameras from their covariance, pixels, planes.
class Chance {
 public:
  Chance(const Survey& survey, uint64_t seed) : survey_(survey), random_(seed) {}

  void Draw() {
    parameters_.clear();
    for (const SurveyPhotograph& photograph : survey_.photographs) {
      const Eigen::LLT<CameraCovariance> root(photograph.covariance);
      CameraParameters normal;
      for (int i = 0; i < kNumCameraParameters; ++i) normal[i] = Normal();
      parameters_.push_back(ParametersFromTag(photograph.tag) + root.matrixL() * normal);
    }
    wall_offset_ = *survey_.model.sigma * Normal();
  }
  // Where the wall is met by the ray of a pixel that was pointed at with an error of sigma_px.
  Eigen::Vector3d OnWall(int photograph, const Eigen::Vector2d& image_px, double sigma_px) {
    const SurveyPhotograph& asked = survey_.photographs[photograph];
    const Camera camera = CameraFromTag(
        TagFromParameters(parameters_[photograph], asked.tag), asked.width_px, asked.height_px);
    const Eigen::Vector2d pointed = image_px + sigma_px * Eigen::Vector2d(Normal(), Normal());
    const Eigen::Vector3d from = camera.PositionInWorld();
    const Eigen::Vector3d along = UnprojectToWorld(camera, pointed);
    // The wall's front looks to the south: its normal is -y.
    return from + along * ((-wall_offset_ - from.y()) / along.y());
  }

 private:
  double Normal() { return normal_(random_); }

  const Survey& survey_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<CameraParameters> parameters_;
  double wall_offset_ = 0;
};

constexpr int kFront = 0;
constexpr int kSide = 1;

TEST(Place, SquareOnAPixelIsDistanceOverFocalLengthWide) {
  Survey survey = MakeWallSurvey();
  survey.photographs[kFront].covariance.setZero();
  const Visibility visibility(survey.model);
  const Eigen::Vector2d left_of_middle_px(150, 200);
  const Place place = PlaceInPhotograph(survey, visibility, kFront, left_of_middle_px, 0);
  const double focal_px = 300 / std::tan(RadiansFromDegrees(30));
  EXPECT_NEAR(place.point_in_world.x(), -150 / focal_px * 30, 1e-9);
  EXPECT_NEAR(place.point_in_world.y(), 0, 1e-9);
  EXPECT_NEAR(place.point_in_world.z(), 5, 1e-9);
  EXPECT_EQ(place.faces, std::vector<int>{kWallFace});
  const Eigen::Matrix3d from_pixel = place.Covariance(ErrorKind::kPixel);
  EXPECT_NEAR(std::sqrt(from_pixel(0, 0)), 30 / focal_px, 1e-9);
  EXPECT_NEAR(std::sqrt(from_pixel(2, 2)), 30 / focal_px, 1e-9);
  EXPECT_NEAR(from_pixel(1, 1), 0, 1e-12);
  // A wall that stands further off is met further along the ray.
  const Eigen::Matrix3d from_model = place.Covariance(ErrorKind::kModel);
  EXPECT_NEAR(std::sqrt(from_model(1, 1)), 0.05, 1e-9);
  EXPECT_NEAR(std::sqrt(from_model(0, 0)), 0.05 * 150 / focal_px, 1e-9);
  EXPECT_NEAR(place.Covariance(ErrorKind::kCamera).norm(), 0, 1e-12);
}

TEST(Place, DeviationsAreThoseOfManyTrials) {
  const Survey survey = MakeWallSurvey();
  const Visibility visibility(survey.model);
  const Eigen::Vector2d image_px(420, 140);
  PickOptions options;
  options.pointing_sigma_px = 0.8;
  const Place place = PlaceInPhotograph(survey, visibility, kSide, image_px, 0, options);
  Chance chance(survey, 7);
  constexpr int kTrials = 20000;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kTrials; ++i) {
    chance.Draw();
    const Eigen::Vector3d error =
        chance.OnWall(kSide, image_px, options.pointing_sigma_px) - place.point_in_world;
    covariance += error * error.transpose() / kTrials;
  }
  // Two standard deviations of a variance from so many trials are 2 %.
  EXPECT_NEAR((covariance - place.Covariance()).norm(), 0, 0.03 * covariance.norm());
}

TEST(Measure, DistanceAndAreaFromOnePhotographAreAsSureAsManyTrialsSay) {
  const Survey survey = MakeWallSurvey();
  const Visibility visibility(survey.model);
  const std::vector<Eigen::Vector2d> pixels = {{120, 120}, {480, 140}, {300, 60}};
  std::vector<Place> places;
  for (int i = 0; i < 3; ++i) {
    places.push_back(PlaceInPhotograph(survey, visibility, kFront, pixels[i], i));
    ASSERT_EQ(places.back().faces.front(), kWallFace);
  }
  const Measure distance = MeasureDistance(places[0], places[1]);
  const Measure area = MeasureArea(places[0], places[1], places[2]);
  Chance chance(survey, 8);
  constexpr int kTrials = 20000;
  double distance_variance = 0;
  double area_variance = 0;
  for (int i = 0; i < kTrials; ++i) {
    chance.Draw();
    std::vector<Eigen::Vector3d> at;
    for (const Eigen::Vector2d& pixel : pixels) at.push_back(chance.OnWall(kFront, pixel, 1));
    distance_variance += std::pow((at[1] - at[0]).norm() - distance.value, 2) / kTrials;
    const double drawn_area = (at[1] - at[0]).cross(at[2] - at[0]).norm() / 2;
    area_variance += std::pow(drawn_area - area.value, 2) / kTrials;
  }
  EXPECT_NEAR(std::sqrt(distance_variance), distance.sigma, 0.02 * distance.sigma);
  EXPECT_NEAR(std::sqrt(area_variance), area.sigma, 0.02 * area.sigma);
  // A camera that stands elsewhere moves both ends alike: less is left than each end has alone.
  const double one_end = std::sqrt(places[0].Covariance(ErrorKind::kCamera)(0, 0));
  EXPECT_LT(distance.camera_sigma, one_end);
}

TEST(Measure, PointsThatAreWrittenDownAreAsSureAsTheModel) {
  const Survey survey = MakeWallSurvey();
  const Place a = PlaceOnModel(survey, {-20, 0, 0}, 0);
  const Place b = PlaceOnModel(survey, {20, 0, 0}, 1);
  const Place c = PlaceOnModel(survey, {-20, 0, 20}, 2);
  const Measure distance = MeasureDistance(a, b);
  EXPECT_DOUBLE_EQ(distance.value, 40);
  EXPECT_NEAR(distance.sigma, 0.05 * std::sqrt(2), 1e-12);
  EXPECT_DOUBLE_EQ(distance.camera_sigma, 0);
  const Measure area = MeasureArea(a, b, c);
  EXPECT_DOUBLE_EQ(area.value, 400);
  // By hand: the corners' gradients are half the opposite sides, 44.72, 20 and 40 long.
  EXPECT_NEAR(area.sigma, 0.05 * std::sqrt(2000 + 400 + 1600) / 2, 1e-9);
}

TEST(Place, ACornerLiesOnAllItsFacesAndAPointInTheAirOnNone) {
  const Survey survey = MakeWallSurvey();
  const Place corner = PlaceOnModel(survey, {2, -10, 4}, 0);
  EXPECT_THAT(corner.faces, testing::UnorderedElementsAre(1, 2));
  const Place above = PlaceOnModel(survey, {0, -0.5, 22}, 1);
  EXPECT_TRUE(above.faces.empty());
  EXPECT_EQ(above.nearest_face, kWallFace);
  EXPECT_NEAR(above.distance_off_model, std::hypot(0.5, 2), 1e-12);
  const Place beside = PlaceOnModel(survey, {23, -4, 10}, 2);
  EXPECT_NEAR(beside.distance_off_model, 5, 1e-12);
}

TEST(Place, APointThatIsNowhereNearTheModelIsRefused) {
  const Survey survey = MakeWallSurvey();
  const std::string message = ThrownMessage([&] { PlaceOnModel(survey, {1e300, 0, 4}, 0); });
  EXPECT_THAT(message, HasSubstr("expected the model's own numbers, about "));
}

TEST(Place, APixelThatShowsNothingSaysSo) {
  const Survey survey = MakeWallSurvey();
  const Visibility visibility(survey.model);
  const auto message = [&](int photograph, const Eigen::Vector2d& px) {
    return ThrownMessage([&] { PlaceInPhotograph(survey, visibility, photograph, px, 0); });
  };
  EXPECT_THAT(message(4, {300, 200}), HasSubstr("away at 300,200: shows nothing of the model"));
  EXPECT_THAT(message(0, {600.5, 200}), HasSubstr("outside of its 600 x 400 pixels"));
  EXPECT_THAT(message(3, {300, 100}), HasSubstr("meets the back of face 1 (wall)"));
  EXPECT_THAT(ThrownMessage([&] { FindSurveyPhotograph(survey, "lost"); }),
              HasSubstr("rejected: the model is not in it"));
  EXPECT_THAT(ThrownMessage([&] { FindSurveyPhotograph(survey, "frnt"); }),
              HasSubstr("no photograph frnt"));
}

}  // namespace
}  // namespace groundglass
