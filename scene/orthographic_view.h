// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

namespace groundglass {

// A picture by parallel rays, square to a plane: the same scale everywhere, as in an elevation or a
// plan. Its axes are those of `image` and `cam`: x right, y down, depth forward, with the plane at
// depth 0. Lengths in the model's unit.
struct OrthographicView {
  int width_px = 0;
  int height_px = 0;
  double pixel_size = 1;                                      // side of a pixel on the plane
  Eigen::Vector3d corner_in_world = Eigen::Vector3d::Zero();  // the top-left one, on the plane
  Eigen::Vector3d right_in_world = Eigen::Vector3d::UnitX();  // unit length
  Eigen::Vector3d down_in_world = -Eigen::Vector3d::UnitZ();  // unit length, square to `right`
  // What lies nearer than the first or beyond the second is not shown.
  double near_depth = -1e9;
  double far_depth = 1e9;

  Eigen::Vector3d ForwardInWorld() const { return right_in_world.cross(down_in_world); }
  // Image point, px, and depth.
  Eigen::Vector3d FromWorld(const Eigen::Vector3d& point_in_world) const {
    const Eigen::Vector3d offset = point_in_world - corner_in_world;
    return {offset.dot(right_in_world) / pixel_size,
            offset.dot(down_in_world) / pixel_size,
            offset.dot(ForwardInWorld())};
  }
  Eigen::Vector3d ToWorld(const Eigen::Vector2d& image_px, double depth) const {
    return corner_in_world +
           pixel_size * (image_px.x() * right_in_world + image_px.y() * down_in_world) +
           depth * ForwardInWorld();
  }
  // A part of the same picture, from this column and row on.
  OrthographicView Part(int column, int row, int part_width_px, int part_height_px) const {
    OrthographicView part = *this;
    part.corner_in_world = ToWorld(Eigen::Vector2d(column, row), 0);
    part.width_px = part_width_px;
    part.height_px = part_height_px;
    return part;
  }
};

}  // namespace groundglass
