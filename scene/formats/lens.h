// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <filesystem>
#include <string>

namespace groundglass {

// What is true of all photographs of one camera: view angle (degrees, horizontal), aspect, shift
// (fractions of the frame's width), k1 and k2, with one standard deviation each; and what a lens
// calibrated elsewhere has besides (camera_model.h), held as it is.
struct Lens {
  std::string name;  // matches the tag's `camera`; empty: serves every photograph
  double view_angle_deg = 0, sigma_view_angle_deg = 0;
  double aspect = 0, sigma_aspect = 0;
  double shift_x = 0, sigma_shift_x = 0;
  double shift_y = 0, sigma_shift_y = 0;
  double k1 = 0, sigma_k1 = 0;
  double k2 = 0, sigma_k2 = 0;
  double k3 = 0, p1 = 0, p2 = 0;
};

// Lens file (docs/lens-file.md): "key value" pairs as in a .view file, `%` comments; or another
// program's (foreign_lens.h). Throws Error naming file, line and key.
Lens ReadLens(const std::filesystem::path& file);
std::string FormatLens(const Lens& lens);

}  // namespace groundglass
