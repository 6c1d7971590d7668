// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake.h"
#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace groundglass {

// Radiance of a place on a face: the truth that a bake must find again.
using Paint = std::function<Eigen::Array3f(int face, const Eigen::Vector3d& point_in_world)>;

// A smooth pattern, different in each channel, a few feet from crest to crest, so that a shift of
// a small part of a texel shows.
Eigen::Array3f Waves(const Eigen::Vector3d& point_in_world);
// The same on every face.
inline const Paint kWaves = [](int, const Eigen::Vector3d& point) { return Waves(point); };

// Adds a face with these corners (counterclockwise seen from its front); returns its number.
int AddFace(PolygonModel& model, const std::vector<Eigen::Vector3d>& corners);
// A wall in the plane y = `y`, its front towards -y, from (x0, z0) to (x1, z1).
int AddWall(PolygonModel& model, double x0, double x1, double z0, double z1, double y = 0);

// A camera at `position` that looks at `target`, its picture level.
Camera LookAt(const Eigen::Vector3d& position,
              const Eigen::Vector3d& target,
              int width_px,
              int height_px,
              double focal_px);

// Ray-casts a photograph of the painted model, 4 x 4 rays a pixel, grey sky. `develop` may change
// the radiance of a pixel, as exposure and passers-by do.
using Develop = std::function<Eigen::Array3f(const Eigen::Array3f&, int x, int y)>;
ImageF TakePhotograph(const PolygonModel& model,
                      const Camera& camera,
                      const Paint& paint,
                      const Develop& develop = {});

// Takes a photograph and writes it to folder/NAME.png (16 bits).
BakePhotograph PhotographPainted(const PolygonModel& model,
                                 const Camera& camera,
                                 const Paint& paint,
                                 const std::filesystem::path& folder,
                                 const std::string& name,
                                 const Develop& develop = {});

// A texel of a face, with the place that its centre stands for.
struct PlacedTexel {
  Eigen::Vector3d point_in_world;
  Eigen::Vector3d right_in_world;  // to the next texel
  Eigen::Vector3d down_in_world;
  Eigen::Array3f radiance;
  int source = 0;                 // provenance
  double texels_from_border = 0;  // of the face
};
// The texels whose centres lie inside the face, found from its corners alone, as any reader of the
// textured model would.
std::vector<PlacedTexel> TexelsOf(const TexturedModel& textured, int face);

}  // namespace groundglass
