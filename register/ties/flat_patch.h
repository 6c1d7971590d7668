// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/tie_picture.h"
#include "scene/camera.h"
#include "scene/image.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

// A square in a face's plane, with texels in rows from its top left.
struct FlatPatch {
  int face = -1;
  Eigen::Vector3d center_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d across_in_world = Eigen::Vector3d::UnitX();  // along its rows, unit length
  Eigen::Vector3d down_in_world = -Eigen::Vector3d::UnitZ();   // to the next row, unit length
  Eigen::Vector3d normal_in_world = Eigen::Vector3d::UnitY();
  double texel = 0;  // a texel's side, model's unit

  // texels: from the centre, columns to the right, rows down.
  Eigen::Vector3d PointInWorld(const Eigen::Vector2d& texels) const {
    return center_in_world + texel * (texels.x() * across_in_world + texels.y() * down_in_world);
  }
};

// A patch about a point of a face, its rows level; the texel's size is still to be said.
FlatPatch LayPatch(const Eigen::Vector3d& point_in_world,
                   int face,
                   const Eigen::Vector3d& normal_in_world);

// d image / d point, px per model's unit; nothing where the camera does not see the point.
std::optional<Eigen::Matrix<double, 2, 3>> ImageByPoint(const Camera& camera,
                                                        const Eigen::Vector3d& point_in_world);
// d image / d (across, down), px per model's unit, at the patch's centre; nothing where the camera
// does not see it.
std::optional<Eigen::Matrix2d> ImageByPatch(const FlatPatch& patch, const Camera& camera);
// Pixels per model's unit in the direction in which they are fewest, of such a derivative.
double LeastPxPerUnit(const Eigen::Matrix2d& image_by_patch);

// The light of the patch, `texels` on a side, as a photograph shows it through a camera; nothing
// unless all of it is evidence.
std::optional<ImageF> FlattenPatch(const FlatPatch& patch,
                                   int texels,
                                   const Camera& camera,
                                   const TiePicture& picture);

// Whether nothing of the model stands before the patch, by its corners, sides' middles and centre,
// and all of them lie on some face in its plane.
bool IsPatchClear(const FlatPatch& patch,
                  int texels,
                  const Camera& camera,
                  const Visibility& visibility);

}  // namespace groundglass
