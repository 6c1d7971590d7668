// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/montage_light.h"

#include "scene/frames.h"
#include "tests/viewer/montage_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace groundglass {
namespace {

// Sightings of walls that look these ways, and of a roof.
std::vector<FaceSighting> SightWalls(const std::vector<double>& bearings_deg,
                                     const MontageLight& light,
                                     const std::function<double(int)>& albedo) {
  std::vector<Eigen::Vector3d> normals = {Eigen::Vector3d::UnitZ()};
  for (const double bearing_deg : bearings_deg) {
    const double bearing = RadiansFromDegrees(bearing_deg);
    normals.emplace_back(std::sin(bearing), std::cos(bearing), 0);
  }
  std::vector<FaceSighting> faces;
  for (size_t i = 0; i < normals.size(); ++i) {
    FaceSighting& face = faces.emplace_back();
    face.normal_in_world = normals[i];
    face.num_pixels = 2000;
    face.seen = albedo(static_cast<int>(i)) * light.On(normals[i]);
  }
  return faces;
}

TEST(MontageLight, ComesBackFromFacesOfKnownColour) {
  std::vector<FaceSighting> faces =
      SightWalls({10, 100, 190, 280}, LowSun(), [](int i) { return 0.2 + 0.1 * i; });
  for (size_t i = 0; i < faces.size(); ++i) {
    faces[i].in_design = Eigen::Vector3d::Constant(0.2 + 0.1 * static_cast<double>(i));
  }
  // One of them was painted since.
  faces[2].seen *= 2.2;
  const MontageLight found = FitMontageLight(faces, {});
  EXPECT_EQ(found.source, LightSource::kDesign);
  EXPECT_EQ(found.num_faces, 5);
  for (size_t i = 0; i < faces.size(); ++i) {
    if (i == 2) continue;
    const Eigen::Vector3d truth = LowSun().On(faces[i].normal_in_world);
    EXPECT_LT((found.On(faces[i].normal_in_world) - truth).norm() / truth.norm(), 0.12) << i;
  }
}

TEST(MontageLight, OfABuildingOfUnknownColourHasItsSunnySideAndAnExposure) {
  std::mt19937 random(7);
  std::normal_distribution<double> spread(0, 0.25);
  std::vector<double> bearings;
  for (int i = 0; i < 24; ++i) bearings.push_back(15.0 * i);
  const MontageLight light = LowSun();
  std::vector<FaceSighting> faces =
      SightWalls(bearings, light, [&](int) { return 0.35 * std::exp(spread(random)); });
  for (int i = 0; i < 5; ++i) faces[5 * i].seen *= 0.5 / 0.35;
  const MontageLight found = FitMontageLight(faces, {});
  EXPECT_EQ(found.source, LightSource::kBuilding);
  const Eigen::Vector2d towards = found.direction_in_world.head<2>().normalized();
  EXPECT_GT(towards.dot(light.direction_in_world.head<2>().normalized()), 0.9);
  const double level = found.On(Eigen::Vector3d::UnitY()).mean();
  EXPECT_NEAR(level / light.On(Eigen::Vector3d::UnitY()).mean(), 1, 0.25);
  // Grey where no texture tells the photograph's cast; with one, as the texture says.
  EXPECT_NEAR(found.gain[0], found.gain[2], 1e-9);
  for (FaceSighting& face : faces) {
    face.on_texture = face.seen.cwiseQuotient(Eigen::Vector3d(1.2, 1, 0.9));
  }
  const MontageLight tinted = FitMontageLight(faces, {});
  EXPECT_NEAR(tinted.gain[0] / tinted.gain[1], 1.2, 1e-6);
  EXPECT_NEAR(tinted.gain[2] / tinted.gain[1], 0.9, 1e-6);
}

TEST(MontageLight, OneWallSaysNothingOfTheOthers) {
  const std::vector<FaceSighting> faces = SightWalls({180}, LowSun(), [](int) { return 0.35; });
  const MontageLight found = FitMontageLight({faces.back()}, {});
  const double east = found.On(Eigen::Vector3d::UnitX()).mean();
  const double west = found.On(-Eigen::Vector3d::UnitX()).mean();
  EXPECT_NEAR(east, west, 1e-9);
  EXPECT_EQ(FitMontageLight({}, {}).source, LightSource::kAssumed);
}

}  // namespace
}  // namespace groundglass
