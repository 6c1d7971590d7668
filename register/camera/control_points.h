// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/scene.h"

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A place in a photograph that a person has recognised as a point of the model.
struct ControlPoint {
  std::string photograph;  // its name, "s5"
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  double sigma_px = 2;  // one standard deviation each way, of pointing and of the model together
};

// Reads a points file (docs/points-file.md): `photograph x_px y_px x y z sigma_px`, one point a
// line, x y z in `site`. Throws Error naming file and line; a photograph with fewer than three
// points is an error too.
std::vector<ControlPoint> ReadControlPoints(const std::filesystem::path& file);

// Throws Error naming the file and the point for one that lies half a frame and more outside its
// photograph (those of other names are left alone), or a hundred models' sizes away from the model.
void CheckControlPoints(const std::filesystem::path& file,
                        const std::vector<ControlPoint>& points,
                        const Scene& scene);

// One line, with the file's name, for each photograph whose points lie on one line of the model.
std::vector<std::string> DescribeThinControlPoints(const std::filesystem::path& file,
                                                   const std::vector<ControlPoint>& points);

}  // namespace groundglass
