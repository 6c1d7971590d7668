// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/texel_map.h"

#include "scene/least_norm.h"

namespace groundglass {

TexelMap FitTexelMap(const PolygonModel& model, int face, const FaceTexture& texture) {
  TexelMap map;
  const std::vector<int>& corners = model.faces[face].points;
  if (texture.page < 0 || texture.corners_texel.size() != corners.size()) return map;
  // The corners lie in a plane, so the least-norm solution about their centre is the map in it.
  const int n = static_cast<int>(corners.size());
  Eigen::MatrixXd points(n, 3);
  Eigen::MatrixXd texels(n, 2);
  for (int i = 0; i < n; ++i) {
    points.row(i) = model.points_in_world[corners[i]];
    texels.row(i) = texture.corners_texel[i];
  }
  const Eigen::RowVector3d point_center = points.colwise().mean();
  const Eigen::RowVector2d texel_center = texels.colwise().mean();
  // In the plane's own two directions: what corners lie off it by is no third.
  const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
  Eigen::Matrix<double, 3, 2> plane_axes;
  plane_axes.col(0) = normal.unitOrthogonal();
  plane_axes.col(1) = normal.cross(plane_axes.col(0));
  const Eigen::MatrixXd linear =
      plane_axes * SolveLeastNorm((points.rowwise() - point_center) * plane_axes,
                                  texels.rowwise() - texel_center);
  map.texel_from_world.leftCols<3>() = linear.transpose();
  map.texel_from_world.col(3) =
      texel_center.transpose() - linear.transpose() * point_center.transpose();
  map.has_texture = true;
  return map;
}

}  // namespace groundglass
