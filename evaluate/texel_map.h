// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/textured_model.h"

namespace groundglass {

// Texture coordinates of a point on a face, by the affine map that the face's corners fix.
struct TexelMap {
  Eigen::Matrix<double, 2, 4> texel_from_world = Eigen::Matrix<double, 2, 4>::Zero();
  bool has_texture = false;

  Eigen::Vector2d TexelAt(const Eigen::Vector3d& point_in_world) const {
    return texel_from_world * point_in_world.homogeneous();
  }
};

TexelMap FitTexelMap(const PolygonModel& model, int face, const FaceTexture& texture);

}  // namespace groundglass
