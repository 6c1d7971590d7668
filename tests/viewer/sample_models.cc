// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/viewer/sample_models.h"

namespace groundglass {

Image8 MakeCheckerPage(int width, int height) {
  Image8 page(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        page.At(x, y)[channel] = (x + y) % 2 == 0 ? 255 : 0;
      }
    }
  }
  return page;
}

Image8 MakePlainPage(int width, int height, uint8_t red, uint8_t green, uint8_t blue) {
  Image8 page(width, height, 3);
  for (size_t i = 0; i < page.values.size(); i += 3) {
    page.values[i] = red;
    page.values[i + 1] = green;
    page.values[i + 2] = blue;
  }
  return page;
}

TexturedModel MakeWall(double width, double height, const Image8& page_srgb8) {
  TexturedModel wall;
  wall.model.points_in_world = {{0, 0, 0}, {width, 0, 0}, {width, 0, height}, {0, 0, height}};
  wall.model.faces = {{{0, 1, 2, 3}, "wall"}};
  const double w = page_srgb8.width;
  const double h = page_srgb8.height;
  wall.faces = {{0, {{0, h}, {w, h}, {w, 0}, {0, 0}}}};
  wall.pages = {{page_srgb8, {}}};
  return wall;
}

TexturedModel MakeCheckeredBox() {
  TexturedModel box;
  for (const double z : {-1.0, 1.0}) {
    box.model.points_in_world.insert(box.model.points_in_world.end(),
                                     {{-2, -1.5, z}, {2, -1.5, z}, {2, 1.5, z}, {-2, 1.5, z}});
  }
  box.model.faces = {{{3, 2, 1, 0}, "floor"},
                     {{4, 5, 6, 7}, "roof"},
                     {{0, 1, 5, 4}, "south"},
                     {{1, 2, 6, 5}, "east"},
                     {{2, 3, 7, 6}, "north"},
                     {{3, 0, 4, 7}, "west"}};
  for (size_t i = 0; i < box.model.faces.size(); ++i) {
    box.faces.push_back({0, {{0, 64}, {64, 64}, {64, 0}, {0, 0}}});
  }
  box.pages = {{MakeCheckerPage(64, 64), {}}};
  return box;
}

Camera MakeCamera(const Eigen::Vector3d& position_in_world,
                  const Eigen::Vector3d& target_in_world,
                  int width_px,
                  int height_px,
                  double focal_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.focal_x_px = camera.focal_y_px = focal_px;
  camera.center_x_px = width_px / 2.0;
  camera.center_y_px = height_px / 2.0;
  const Eigen::Vector3d forward = (target_in_world - position_in_world).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d down = forward.cross(right);
  camera.cam_from_world.rotation << right.transpose(), down.transpose(), forward.transpose();
  camera.cam_from_world.translation = -(camera.cam_from_world.rotation * position_in_world);
  return camera;
}

}  // namespace groundglass
