// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/flat_patch.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

FlatPatch LayPatch(const Eigen::Vector3d& point_in_world,
                   int face,
                   const Eigen::Vector3d& normal_in_world) {
  FlatPatch patch;
  patch.face = face;
  patch.center_in_world = point_in_world;
  patch.normal_in_world = normal_in_world;
  const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(normal_in_world);
  // A floor or a flat roof has no level direction of its own.
  patch.across_in_world = level.norm() > 1e-3 ? level.normalized() : Eigen::Vector3d::UnitX();
  patch.down_in_world = patch.across_in_world.cross(normal_in_world).normalized();
  patch.across_in_world = normal_in_world.cross(patch.down_in_world);
  return patch;
}

std::optional<Eigen::Matrix<double, 2, 3>> ImageByPoint(const Camera& camera,
                                                        const Eigen::Vector3d& point_in_world) {
  const Eigen::Vector3d point_in_cam = camera.cam_from_world * point_in_world;
  if (!ProjectFromCam(camera, point_in_cam)) return std::nullopt;
  const Eigen::Vector2d normalised = point_in_cam.head<2>() / point_in_cam.z();
  const Eigen::Matrix3d& rotation = camera.cam_from_world.rotation;
  const Eigen::Matrix<double, 2, 3> normalised_by_point =
      (rotation.topRows<2>() - normalised * rotation.row(2)) / point_in_cam.z();
  return ImageFromNormalisedDerivative(camera, normalised) * normalised_by_point;
}

std::optional<Eigen::Matrix2d> ImageByPatch(const FlatPatch& patch, const Camera& camera) {
  const auto image_by_point = ImageByPoint(camera, patch.center_in_world);
  if (!image_by_point) return std::nullopt;
  Eigen::Matrix<double, 3, 2> directions;
  directions << patch.across_in_world, patch.down_in_world;
  return *image_by_point * directions;
}

double LeastPxPerUnit(const Eigen::Matrix2d& image_by_patch) {
  const Eigen::Matrix2d square = image_by_patch.transpose() * image_by_patch;
  const double least =
      0.5 * square.trace() - std::hypot(0.5 * (square(0, 0) - square(1, 1)), square(0, 1));
  return std::sqrt(std::max(0.0, least));
}

std::optional<ImageF> FlattenPatch(const FlatPatch& patch,
                                   int texels,
                                   const Camera& camera,
                                   const TiePicture& picture) {
  const std::optional<Eigen::Matrix2d> image_by_patch = ImageByPatch(patch, camera);
  if (!image_by_patch) return std::nullopt;
  const double px_per_texel = patch.texel * LeastPxPerUnit(*image_by_patch);
  ImageF flat(texels, texels, 1);
  const double middle = 0.5 * (texels - 1);
  for (int row = 0; row < texels; ++row) {
    for (int column = 0; column < texels; ++column) {
      const auto image_px = Project(camera, patch.PointInWorld({column - middle, row - middle}));
      if (!image_px) return std::nullopt;
      const std::optional<float> light = picture.LightAt(*image_px, px_per_texel);
      if (!light) return std::nullopt;
      *flat.At(column, row) = *light;
    }
  }
  return flat;
}

bool IsPatchClear(const FlatPatch& patch,
                  int texels,
                  const Camera& camera,
                  const Visibility& visibility) {
  const Eigen::Vector3d position_in_world = camera.PositionInWorld();
  const double half = 0.5 * texels;
  for (const double y : {0.0, -half, half}) {
    for (const double x : {0.0, -half, half}) {
      const Eigen::Vector3d to_point = patch.PointInWorld({x, y}) - position_in_world;
      const double distance = to_point.norm();
      const auto hit = visibility.FirstHit(position_in_world, to_point / distance);
      // Along the normal: a ray that grazes meets the plane late.
      const double slant = std::abs(to_point.dot(patch.normal_in_world)) / distance;
      if (!hit || std::abs(hit->distance - distance) * slant > visibility.DefaultTolerance()) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace groundglass
