// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/register/house.h"

#include "scene/srgb.h"
#include "scene/visibility.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace groundglass {

PolygonModel MakeHouse() {
  PolygonModel model;
  const auto point = [&](double x, double y, double z) {
    model.points_in_world.push_back({x, y, z});
    return static_cast<int>(model.points_in_world.size()) - 1;
  };
  const auto face = [&](std::vector<int> points) {
    model.faces.push_back({std::move(points), ""});
  };
  // A box seen from outside, counterclockwise; without its floor.
  const auto walls = [&](double x0, double y0, double x1, double y1, double height) {
    const int a = point(x0, y0, 0), b = point(x1, y0, 0), c = point(x1, y1, 0),
              d = point(x0, y1, 0);
    const int e = point(x0, y0, height), f = point(x1, y0, height), g = point(x1, y1, height),
              i = point(x0, y1, height);
    face({a, b, f, e});
    face({c, d, i, g});
    return std::array<int, 8>{a, b, c, d, e, f, g, i};
  };
  const std::array<int, 8> hall = walls(0, 0, 40, 20, 16);
  const int ridge_west = point(0, 10, 24);
  const int ridge_east = point(40, 10, 24);
  face({hall[1], hall[2], hall[6], ridge_east, hall[5]});
  face({hall[3], hall[0], hall[4], ridge_west, hall[7]});
  face({hall[4], hall[5], ridge_east, ridge_west});
  face({hall[6], hall[7], ridge_west, ridge_east});
  const std::array<int, 8> chimney = walls(30, 3, 33, 6, 27);
  face({chimney[1], chimney[2], chimney[6], chimney[5]});
  face({chimney[3], chimney[0], chimney[4], chimney[7]});
  face({chimney[4], chimney[5], chimney[6], chimney[7]});
  const std::array<int, 8> shed = walls(8, -9, 19, 0, 8);
  face({shed[1], shed[2], shed[6], shed[5]});
  face({shed[3], shed[0], shed[4], shed[7]});
  face({shed[4], shed[5], shed[6], shed[7]});
  return model;
}

Image8 PhotographModel(const PolygonModel& model,
                       const Camera& camera,
                       double noise_levels,
                       uint64_t seed) {
  constexpr int kRays = 3;
  const Visibility visibility(model);
  const Eigen::Vector3d position = camera.PositionInWorld();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, noise_levels);
  Image8 photograph(camera.width_px, camera.height_px, 1);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      float light = 0;
      for (int ray = 0; ray < kRays * kRays; ++ray) {
        const int row = ray / kRays;
        const Eigen::Vector2d at(x + (ray % kRays + 0.5) / kRays, y + (row + 0.5) / kRays);
        const auto hit = visibility.FirstHit(position, UnprojectToWorld(camera, at));
        const int code = hit ? 40 + 29 * (hit->face * 5 % 6) : 225;
        light += LinearFromSrgb(static_cast<float>(code) / 255);
      }
      const double code = 255 * SrgbFromLinear(light / (kRays * kRays));
      *photograph.At(x, y) =
          static_cast<uint8_t>(std::clamp(code + noise(random) + 0.5, 0.0, 255.0));
    }
  }
  return photograph;
}

double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found) {
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& point : model.points_in_world) {
    const auto a = Project(truth, point);
    const auto b = Project(found, point);
    if (!a || !b || !IsInsideFrame(truth, *a)) continue;
    sum += (*a - *b).norm();
    ++count;
  }
  return count ? sum / count : 0;
}

}  // namespace groundglass
