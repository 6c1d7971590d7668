// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/invrender/painted_scene.h"

#include "scene/formats/image_io.h"
#include "scene/srgb.h"
#include "scene/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {

Eigen::Array3f Waves(const Eigen::Vector3d& p) {
  const auto wave = [](double phase) { return static_cast<float>(0.35 + 0.2 * std::sin(phase)); };
  return {wave(1.3 * p.x() + 0.9 * p.z() + p.y()),
          wave(-0.8 * p.x() + 1.4 * p.z() + 0.7 * p.y() + 1),
          wave(1.1 * p.x() - 1.2 * p.z() + 1.3 * p.y() + 2)};
}

int AddFace(PolygonModel& model, const std::vector<Eigen::Vector3d>& corners) {
  Face face;
  for (const Eigen::Vector3d& corner : corners) {
    face.points.push_back(static_cast<int>(model.points_in_world.size()));
    model.points_in_world.push_back(corner);
  }
  model.faces.push_back(face);
  return static_cast<int>(model.faces.size()) - 1;
}

int AddWall(PolygonModel& model, double x0, double x1, double z0, double z1, double y) {
  return AddFace(model, {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}});
}

Camera LookAt(const Eigen::Vector3d& position,
              const Eigen::Vector3d& target,
              int width_px,
              int height_px,
              double focal_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.focal_x_px = focal_px;
  camera.focal_y_px = focal_px;
  camera.center_x_px = width_px / 2.0;
  camera.center_y_px = height_px / 2.0;
  const Eigen::Vector3d forward = (target - position).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  camera.cam_from_world.rotation.row(0) = right;
  camera.cam_from_world.rotation.row(1) = forward.cross(right);
  camera.cam_from_world.rotation.row(2) = forward;
  camera.cam_from_world.translation = -(camera.cam_from_world.rotation * position);
  return camera;
}

ImageF TakePhotograph(const PolygonModel& model,
                      const Camera& camera,
                      const Paint& paint,
                      const Develop& develop) {
  constexpr int kRays = 4;
  const Visibility visibility(model);
  const Eigen::Vector3d position = camera.PositionInWorld();
  ImageF photograph(camera.width_px, camera.height_px, 3);
  tbb::parallel_for(0, camera.height_px, [&](int y) {
    for (int x = 0; x < camera.width_px; ++x) {
      Eigen::Array3f sum = Eigen::Array3f::Zero();
      for (int j = 0; j < kRays; ++j) {
        for (int i = 0; i < kRays; ++i) {
          const Eigen::Vector3d direction =
              UnprojectToWorld(camera, {x + (i + 0.5) / kRays, y + (j + 0.5) / kRays});
          const auto hit = visibility.FirstHit(position, direction);
          if (hit) {
            sum += paint(hit->face, position + hit->distance * direction);
          } else {
            sum += 0.8f;
          }
        }
      }
      Eigen::Array3f radiance = sum / (kRays * kRays);
      if (develop) radiance = develop(radiance, x, y);
      for (int c = 0; c < 3; ++c) photograph.At(x, y)[c] = radiance[c];
    }
  });
  return photograph;
}

BakePhotograph PhotographPainted(const PolygonModel& model,
                                 const Camera& camera,
                                 const Paint& paint,
                                 const std::filesystem::path& folder,
                                 const std::string& name,
                                 const Develop& develop) {
  BakePhotograph photograph;
  photograph.name = name;
  photograph.image_file = folder / (name + ".png");
  photograph.camera = camera;
  WriteRadiance(photograph.image_file, TakePhotograph(model, camera, paint, develop), {.bits = 16});
  return photograph;
}

std::vector<PlacedTexel> TexelsOf(const TexturedModel& textured, int face) {
  std::vector<PlacedTexel> texels;
  const FaceTexture& texture = textured.faces[face];
  if (texture.page < 0) return texels;
  const TexturePage& page = textured.pages[texture.page];
  const std::vector<int>& points = textured.model.faces[face].points;
  // world = A (u, v, 1), from the corners.
  const Eigen::Index num_corners = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd from(num_corners, 3);
  Eigen::MatrixXd to(num_corners, 3);
  for (Eigen::Index i = 0; i < num_corners; ++i) {
    from.row(i) << texture.corners_texel[i].transpose(), 1;
    to.row(i) = textured.model.points_in_world[points[i]].transpose();
  }
  const Eigen::Matrix3d world_from_texel = from.colPivHouseholderQr().solve(to).transpose();
  for (int y = 0; y < page.srgb8.height; ++y) {
    for (int x = 0; x < page.srgb8.width; ++x) {
      const Eigen::Vector2d centre(x + 0.5, y + 0.5);
      bool is_inside = false;
      double from_border = 1e300;
      for (Eigen::Index i = 0; i < num_corners; ++i) {
        const Eigen::Vector2d& a = texture.corners_texel[i];
        const Eigen::Vector2d& b = texture.corners_texel[(i + 1) % num_corners];
        const double along = std::clamp((centre - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        from_border = std::min(from_border, (a + along * (b - a) - centre).norm());
        if ((a.y() <= centre.y()) == (b.y() <= centre.y())) continue;
        const double crossing = a.x() + (centre.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        if (crossing > centre.x()) is_inside = !is_inside;
      }
      if (!is_inside) continue;
      PlacedTexel& texel = texels.emplace_back();
      texel.point_in_world = world_from_texel * centre.homogeneous();
      texel.right_in_world = world_from_texel.col(0);
      texel.down_in_world = world_from_texel.col(1);
      for (int c = 0; c < 3; ++c) {
        texel.radiance[c] = LinearFromSrgb(page.srgb8.At(x, y)[c] / 255.0f);
      }
      texel.texels_from_border = from_border;
      texel.source = *page.provenance.At(x, y);
    }
  }
  return texels;
}

}  // namespace groundglass
