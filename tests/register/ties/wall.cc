// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/register/ties/wall.h"

#include "scene/srgb.h"
#include "scene/view_tag.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

PolygonModel MakeWall() {
  PolygonModel model;
  model.points_in_world = {{0, 0, 0},
                           {40, 0, 0},
                           {40, 0, 20},
                           {0, 0, 20},
                           {-40, -80, 0},
                           {80, -80, 0},
                           {80, 0, 0},
                           {-40, 0, 0}};
  model.faces = {{{0, 1, 2, 3}, "wall"}, {{4, 5, 6, 7}, "ground"}};
  return model;
}

Camera CameraBeforeWall(double x, double distance, double lookat_x) {
  ViewTag tag;
  tag.position_in_site = {x, distance, 6};
  tag.lookat_in_site = {lookat_x, 0, 10};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  return CameraFromTag(tag, 600, 400);
}

float PlasterLight(double x, double z) {
  double light = 0.45;
  // Waves in directions and of lengths without a common measure.
  double length = 7;
  for (int i = 0; i < 9; ++i, length *= 0.77) {
    const double direction = 2.399963 * i;
    light +=
        0.06 * std::sin(6.2831853 / length * (x * std::cos(direction) + z * std::sin(direction)) +
                        1.7 * i * i);
  }
  return static_cast<float>(std::clamp(light, 0.0, 1.0));
}

Image8 PhotographPlaster(const Camera& camera, double recess) {
  constexpr int kRays = 3;
  const Eigen::Vector3d position = camera.PositionInWorld();
  Image8 photograph(camera.width_px, camera.height_px, 1);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      float light = 0;
      for (int ray = 0; ray < kRays * kRays; ++ray) {
        const int column = ray % kRays;
        const int row = ray / kRays;
        const Eigen::Vector3d direction =
            UnprojectToWorld(camera, {x + (column + 0.5) / kRays, y + (row + 0.5) / kRays});
        const Eigen::Vector3d at = position + (recess - position.y()) / direction.y() * direction;
        light += PlasterLight(at.x(), at.z());
      }
      *photograph.At(x, y) =
          static_cast<uint8_t>(std::lround(255 * SrgbFromLinear(light / (kRays * kRays))));
    }
  }
  return photograph;
}

}  // namespace groundglass
