// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/daylight.h"

#include "datasets-synthetic/noise.h"
#include "scene/frames.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

// Cosine-weighted directions about +z, the same for every place: Malley's method on a spiral.
std::vector<Eigen::Vector3d> CosineDirections(int count) {
  std::vector<Eigen::Vector3d> directions;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double radius = std::sqrt((i + 0.5) / count);
    // Half a step on: from a wall no ray may run level, or rounding would say whether it sees sky.
    const double angle = golden_angle * (i + 0.5);
    directions.push_back(
        {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius)});
  }
  return directions;
}

// Averages each grid point with its neighbours, to hide the steps of a finite number of rays.
std::vector<float> Smoothed(const std::vector<float>& values, int columns, int rows) {
  std::vector<float> result(values.size());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      float sum = 0;
      float weight = 0;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          const int r = row + dr;
          const int c = column + dc;
          if (r < 0 || c < 0 || r >= rows || c >= columns) continue;
          const float w = (dr == 0 ? 2.0f : 1.0f) * (dc == 0 ? 2.0f : 1.0f);
          sum += w * values[static_cast<size_t>(r) * columns + c];
          weight += w;
        }
      }
      result[static_cast<size_t>(row) * columns + column] = sum / weight;
    }
  }
  return result;
}

}  // namespace

Daylight MakeOvercast(uint64_t seed) {
  Daylight light;
  light.seed = seed;
  light.sky = Rgb(0.98f, 1.0f, 1.02f) * 1.25f;
  light.zenith = Rgb(0.78f, 0.81f, 0.85f);
  light.horizon = Rgb(0.66f, 0.69f, 0.73f);
  return light;
}

Daylight MakeSunny(double azimuth_deg, double elevation_deg, uint64_t seed) {
  Daylight light;
  light.seed = seed;
  light.is_sunny = true;
  light.cloud_cover = 0.2 + 0.35 * UniformOf(SeedFor(seed, "clouds"));
  const double azimuth = RadiansFromDegrees(azimuth_deg);
  const double elevation = RadiansFromDegrees(elevation_deg);
  light.to_sun = {std::cos(elevation) * std::sin(azimuth),
                  std::cos(elevation) * std::cos(azimuth),
                  std::sin(elevation)};
  // Low sun is redder.
  const auto warmth = static_cast<float>(std::exp(-elevation_deg / 18));
  light.sun = Rgb(1.06f, 0.99f - 0.1f * warmth, 0.9f - 0.3f * warmth) * 0.98f;
  light.sky = Rgb(0.3f, 0.36f, 0.45f);
  light.zenith = Rgb(0.16f, 0.29f, 0.56f);
  light.horizon = Rgb(0.5f, 0.6f, 0.72f);
  return light;
}

Rgb SkyRadiance(const Daylight& light, const Eigen::Vector3d& direction) {
  const double height = std::max(0.0, direction.z());
  Rgb color =
      light.horizon + static_cast<float>(std::pow(height, 0.45)) * (light.zenith - light.horizon);
  // Clouds lie on a plane overhead, so they flatten towards the horizon.
  const double reach = 1 / (height + 0.12);
  const double x = direction.x() * reach;
  const double y = direction.y() * reach;
  const double width = 0.004 * reach;
  const double density =
      FilteredNoise(SeedFor(light.seed, "sky"), x, y, light.is_sunny ? 1.1 : 0.6, 6, width, width);
  if (light.is_sunny) {
    const double cloud = std::clamp((density - 0.45 + light.cloud_cover) * 2.2, 0.0, 1.0);
    const double fade = std::clamp(height * 9, 0.0, 1.0);
    color += static_cast<float>(0.8 * cloud * fade) * (Rgb(0.86f, 0.87f, 0.9f) - color);
  } else {
    color *= static_cast<float>(1 + 0.1 * light.cloud_cover * density);
  }
  return color;
}

SkyMap::SkyMap(const SyntheticWorld& world,
               const Visibility& visibility,
               const Eigen::Vector3d& center,
               double radius)
    : grids_(world.geometry.faces.size()) {
  constexpr int kNumRays = 96;
  constexpr double kStep = 2;
  constexpr int kMaxPoints = 200;
  const std::vector<Eigen::Vector3d> directions = CosineDirections(kNumRays);
  tbb::parallel_for(size_t{0}, grids_.size(), [&](size_t face) {
    Grid& grid = grids_[face];
    const Surface& surface = world.surfaces[face];
    const FacePlane plane = ComputeFacePlane(world.geometry, static_cast<int>(face));
    const Eigen::Vector3d& normal = plane.normal_in_world;
    grid.open = static_cast<float>((1 + normal.z()) / 2);
    for (const int point : world.geometry.faces[face].points) {
      if ((world.geometry.points_in_world[point] - center).norm() > radius) return;
    }
    const double extent = std::max(surface.high_u - surface.low_u, surface.high_v - surface.low_v);
    grid.step = std::max(kStep, extent / kMaxPoints);
    grid.low_u = surface.low_u;
    grid.low_v = surface.low_v;
    grid.columns = 1 + static_cast<int>(std::ceil((surface.high_u - surface.low_u) / grid.step));
    grid.rows = 1 + static_cast<int>(std::ceil((surface.high_v - surface.low_v) / grid.step));
    grid.shares.resize(static_cast<size_t>(grid.columns) * grid.rows);
    const Eigen::Vector3d tangent = normal.unitOrthogonal();
    const Eigen::Vector3d bitangent = normal.cross(tangent);
    // point = u axis_u / |axis_u|^2 + v axis_v / |axis_v|^2 + normal part
    const Eigen::Vector3d along_u = surface.axis_u / surface.axis_u.squaredNorm();
    const Eigen::Vector3d along_v = surface.axis_v / surface.axis_v.squaredNorm();
    // Points on the rim move inwards, or they would lie on the neighbouring wall.
    constexpr double kInset = 0.2;
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const double u = std::clamp(grid.low_u + column * grid.step,
                                    surface.low_u + kInset,
                                    std::max(surface.low_u + kInset, surface.high_u - kInset));
        const double v = std::clamp(grid.low_v + row * grid.step,
                                    surface.low_v + kInset,
                                    std::max(surface.low_v + kInset, surface.high_v - kInset));
        const Eigen::Vector3d point = along_u * (u - surface.offset_u) +
                                      along_v * (v - surface.offset_v) +
                                      normal * (plane.offset + 0.02);
        int num_open = 0;
        for (const Eigen::Vector3d& local : directions) {
          const Eigen::Vector3d direction =
              local.x() * tangent + local.y() * bitangent + local.z() * normal;
          if (direction.z() <= 0) continue;
          if (!visibility.FirstHit(point, direction)) ++num_open;
        }
        grid.shares[static_cast<size_t>(row) * grid.columns + column] =
            static_cast<float>(num_open) / kNumRays;
      }
    }
    grid.shares = Smoothed(grid.shares, grid.columns, grid.rows);
  });
}

Rgb IndirectIrradiance(const Daylight& light, float sky_share) {
  return sky_share * light.sky +
         (1 - sky_share) *
             (0.17f * light.sky + 0.16f * light.sun * static_cast<float>(light.to_sun.z()));
}

double SkyMap::SkyShare(const Surface& surface, int face, double u, double v) const {
  if (face >= static_cast<int>(grids_.size())) {
    // Things that stand about in one photograph only.
    return (1 + surface.axis_u.cross(surface.axis_v).z()) / 2;
  }
  const Grid& grid = grids_[face];
  if (grid.shares.empty()) return grid.open;
  const double x = std::clamp((u - grid.low_u) / grid.step, 0.0, grid.columns - 1.0);
  const double y = std::clamp((v - grid.low_v) / grid.step, 0.0, grid.rows - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(0, grid.columns - 2));
  const int row = std::min(static_cast<int>(y), std::max(0, grid.rows - 2));
  const int next_column = std::min(column + 1, grid.columns - 1);
  const int next_row = std::min(row + 1, grid.rows - 1);
  const auto share = [&](int c, int r) {
    return grid.shares[static_cast<size_t>(r) * grid.columns + c];
  };
  return std::lerp(std::lerp(share(column, row), share(next_column, row), x - column),
                   std::lerp(share(column, next_row), share(next_column, next_row), x - column),
                   y - row);
}

}  // namespace groundglass
