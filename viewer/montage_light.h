// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace groundglass {

struct MontageLightOptions {
  // A face tells of the light from this many pixels on.
  int least_pixels = 60;
  // Codes of the photograph below and above tell nothing: black and burnt out.
  int darkest_code = 8;
  int brightest_code = 247;
  // Nearer to a face's border than this neighbours and errors of the model mix in, px.
  int border_px = 2;
  // A face that the design repeats tells of it where it shows at least this share of what is seen.
  double least_in_design = 0.9;
  // Where nobody says what the building reflects: of its surface that is seen this share reflects
  // less than bright_albedo, and the rest more. Dark materials differ by their multiples (slate
  // 0.1, brick 0.15 to 0.3), light ones hardly (stone, concrete, render 0.4 to 0.7).
  double bright_share = 0.93;
  double bright_albedo = 0.5;
  // Faces whose colours differ by less than this, as logarithms of red over green and of blue over
  // green, are of one material.
  double same_material = 0.3;
  // How much what they reflect differs, one standard deviation of its logarithm: between
  // materials, and between faces of one material, or of a colour that the design says.
  double material_sigma = 0.6;
  double face_sigma = 0.15;
  // The light before any face is looked at: how much more than the average a level face that looks
  // up gets, and one standard deviation of that and of the other two directions.
  double expected_from_above = 0.25;
  double direction_sigma = 1;
  // No face gets less than this share of the average.
  double least_share = 0.2;

  void Check() const;  // throws Error naming the first field out of range
};

// How the photograph shows one face of the building.
struct FaceSighting {
  Eigen::Vector3d normal_in_world = Eigen::Vector3d::UnitZ();
  int num_pixels = 0;
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();  // linear light, red, green, blue
  // The same face as the design colours it, where it repeats the building.
  std::optional<Eigen::Vector3d> in_design;
  // The same face on the building's own texture.
  std::optional<Eigen::Vector3d> on_texture;
};

enum class LightSource {
  kDesign,    // faces of the building that the design repeats in colours of its own
  kBuilding,  // the building's faces, the lightest taken to reflect what light ones do
  kAssumed,   // the photograph shows too little of the building: even light, white is white
};

// What turns reflectance into the photograph's light: for a face with unit normal n
//   seen = gain * reflectance * max(average + direction . n, least_share * average)
struct MontageLight {
  LightSource source = LightSource::kAssumed;
  int num_faces = 0;  // that tell of it
  Eigen::Vector3d gain = Eigen::Vector3d::Ones();
  double average = 1;
  Eigen::Vector3d direction_in_world = Eigen::Vector3d::Zero();
  double least_share = 0.2;

  Eigen::Vector3d On(const Eigen::Vector3d& normal_in_world) const;
};

// Exposure and colour from the median of what is seen over what is reflected, the light's
// direction from what faces of one material differ in, by robust least squares (first-order
// spherical harmonics; Ramamoorthi and Hanrahan, SIGGRAPH 2001), held by its prior where the faces
// look one way only. Where the design says no colours the photograph's cast is that against the
// building's texture, which is the mean of all photographs.
MontageLight FitMontageLight(const std::vector<FaceSighting>& faces,
                             const MontageLightOptions& options);

}  // namespace groundglass
