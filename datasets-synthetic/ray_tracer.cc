// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/ray_tracer.h"

#include "datasets-synthetic/noise.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace groundglass {
namespace {

constexpr int kSky = -1;
// Rays leave a surface this far off it (feet), beyond the tracer's single precision.
constexpr double kOffSurface = 0.02;
constexpr double kSunRadius = 0.00465;  // radians
constexpr double kHazeDistance = 7000;  // feet

// What the ray through a pixel's corner found.
struct Probe {
  int face = kSky;
  // Which of the sun's four rim points the place sees: all bits, none, or a half shadow.
  uint8_t sun_bits = 0;

  bool operator==(const Probe&) const = default;
};

// Directions to points on the sun's rim, and within its disc.
struct SunDisc {
  Eigen::Vector3d to_sun, across, other;

  explicit SunDisc(const Eigen::Vector3d& to_sun_)
      : to_sun(to_sun_), across(to_sun_.unitOrthogonal()), other(to_sun_.cross(across)) {}
  Eigen::Vector3d Toward(double radius, double angle) const {
    return (to_sun + kSunRadius * radius * (std::cos(angle) * across + std::sin(angle) * other))
        .normalized();
  }
};

// The pixel as a bundle of rays: its middle direction and the steps to its neighbours.
struct PixelRays {
  Eigen::Vector3d origin;
  Eigen::Vector3d corner;  // direction through the top-left corner, not normalised
  Eigen::Vector3d step_x, step_y;

  Eigen::Vector3d Direction(double x, double y) const {
    return (corner + x * step_x + y * step_y).normalized();
  }
};

// The world's faces as rays from one place meet them: where, and with what light.
class SurfaceShader {
 public:
  SurfaceShader(const RayScene& scene, const Eigen::Vector3d& origin)
      : scene_(scene), origin_(origin) {
    for (int face = 0; face < static_cast<int>(scene.world.geometry.faces.size()); ++face) {
      planes_.push_back(ComputeFacePlane(scene.world.geometry, face));
    }
  }

  // The side of a face that the ray meets, a little off its surface.
  Eigen::Vector3d LiftedPoint(int face,
                              const Eigen::Vector3d& point,
                              const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d& normal = planes_[face].normal_in_world;
    return point + (normal.dot(direction) < 0 ? kOffSurface : -kOffSurface) * normal;
  }

  bool FacesSun(int face, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d& normal = planes_[face].normal_in_world;
    return normal.dot(scene_.light.to_sun) * normal.dot(direction) < 0;
  }

  double DistanceAlong(int face, const Eigen::Vector3d& direction) const {
    const FacePlane& plane = planes_[face];
    const double approach = plane.normal_in_world.dot(direction);
    // A ray beside the face may run along its plane: let it end far away.
    if (std::abs(approach) < 1e-9) return 1e5;
    const double distance = (plane.offset - plane.normal_in_world.dot(origin_)) / approach;
    return distance > 0 ? distance : 1e5;
  }

  // Light that leaves a place towards the camera; `share` is the sample's part of the pixel's
  // width.
  Rgb Shade(const PixelRays& rays,
            int face,
            const Eigen::Vector3d& direction,
            double distance,
            bool in_sun,
            double share) const {
    const Surface& surface = scene_.world.surfaces[face];
    const Eigen::Vector3d point = origin_ + distance * direction;
    const Eigen::Vector2d texture = surface.TextureOf(point);
    const Eigen::Vector2d width = FootprintOf(rays, face, direction, distance) * share;
    const Appearance appearance =
        AppearanceAt(surface, texture.x(), texture.y(), width.x(), width.y());

    Eigen::Vector3d normal = planes_[face].normal_in_world;
    if (normal.dot(direction) > 0) normal = -normal;
    const Daylight& light = scene_.light;
    auto sky_share =
        static_cast<float>(scene_.sky_map.SkyShare(surface, face, texture.x(), texture.y()));
    const bool is_ground = normal.z() > 0.99 && point.z() < 0.5 && surface.mask_code == 0;
    if (is_ground) {
      sky_share *= static_cast<float>(scene_.world.SkyLeftAt(point.head<2>()));
    }
    Rgb irradiance = IndirectIrradiance(light, sky_share);
    if (in_sun)
      irradiance += static_cast<float>(std::max(0.0, normal.dot(light.to_sun))) * light.sun;
    Rgb color = appearance.albedo.cwiseProduct(irradiance);
    if (appearance.gloss > 0) {
      color += appearance.gloss * MirrorRadiance(point, direction, normal, face);
    }
    const auto haze = static_cast<float>(1 - std::exp(-distance / kHazeDistance));
    return color + haze * (light.horizon - color);
  }

 private:
  // What glass mirrors, by Schlick's approximation of Fresnel's law with a little more for
  // coatings.
  Rgb MirrorRadiance(const Eigen::Vector3d& point,
                     const Eigen::Vector3d& direction,
                     const Eigen::Vector3d& normal,
                     int face) const {
    const double cosine = std::abs(normal.dot(direction));
    const auto reflectance = static_cast<float>(0.07 + 0.93 * std::pow(1 - cosine, 5));
    const Eigen::Vector3d mirrored = direction - 2 * normal.dot(direction) * normal;
    const auto hit = scene_.visibility.FirstHit(LiftedPoint(face, point, direction), mirrored);
    if (!hit) return reflectance * SkyRadiance(scene_.light, mirrored);
    const Surface& seen = scene_.world.surfaces[hit->face];
    const Rgb irradiance = 0.6f * scene_.light.sky + 0.3f * scene_.light.sun;
    return reflectance * seen.color.cwiseProduct(irradiance);
  }

  // The pixel's extent on the face, in feet along u and v.
  Eigen::Vector2d FootprintOf(const PixelRays& rays,
                              int face,
                              const Eigen::Vector3d& direction,
                              double distance) const {
    const Surface& surface = scene_.world.surfaces[face];
    const Eigen::Vector3d& normal = planes_[face].normal_in_world;
    const double approach = normal.dot(direction);
    constexpr double kLargest = 300;  // feet: at grazing angles the pixel reaches to the horizon
    if (std::abs(approach) < 1e-6) return {kLargest, kLargest};
    // The differential of the point where a ray meets the plane (Igehy 1999, eq. 10), for a
    // direction whose length is that of the pixel's own ray.
    const double length = (rays.corner + 0.5 * (rays.step_x + rays.step_y)).norm();
    const auto moved = [&](const Eigen::Vector3d& step) -> Eigen::Vector3d {
      const Eigen::Vector3d turn = step / length;
      return distance * (turn - normal.dot(turn) / approach * direction);
    };
    const Eigen::Vector3d along_x = moved(rays.step_x);
    const Eigen::Vector3d along_y = moved(rays.step_y);
    const auto extent = [&](const Eigen::Vector3d& axis) {
      return std::min(kLargest, std::abs(axis.dot(along_x)) + std::abs(axis.dot(along_y)));
    };
    return {extent(surface.axis_u), extent(surface.axis_v)};
  }

  const RayScene& scene_;
  Eigen::Vector3d origin_;
  std::vector<FacePlane> planes_;
};

// Sends the rays of each pixel: first through the corners, to see whether it is all of a piece.
class PathTracer {
 public:
  PathTracer(const RayScene& scene, const Camera& camera, uint64_t seed)
      : scene_(scene),
        camera_(camera),
        seed_(seed),
        sun_(scene.light.to_sun),
        cells_(std::max(1, static_cast<int>(std::lround(std::sqrt(scene.rays_per_edge_pixel))))),
        origin_(camera.PositionInWorld()),
        shader_(scene, origin_) {}

  ImageF Render() const {
    const int width = camera_.width_px;
    const int height = camera_.height_px;
    const std::vector<Probe> probes = ProbeCorners();
    ImageF radiance(width, height, 3);
    tbb::parallel_for(tbb::blocked_range<int>(0, height, 8), [&](const auto& rows) {
      for (int y = rows.begin(); y != rows.end(); ++y) {
        for (int x = 0; x < width; ++x) {
          const Probe* top = &probes[static_cast<size_t>(y) * (width + 1) + x];
          const PixelRays rays = RaysOf(x, y);
          const Rgb color =
              IsUniform(top, top + width + 1) ? UniformPixel(rays, top[0]) : MixedPixel(rays, x, y);
          for (int c = 0; c < 3; ++c) radiance.At(x, y)[c] = color[c];
        }
      }
    });
    return radiance;
  }

 private:
  // What is seen through the corners of all pixels, row by row.
  std::vector<Probe> ProbeCorners() const {
    const int width = camera_.width_px;
    const int height = camera_.height_px;
    std::vector<Probe> probes(static_cast<size_t>(width + 1) * (height + 1));
    tbb::parallel_for(tbb::blocked_range<int>(0, height + 1, 8), [&](const auto& rows) {
      for (int y = rows.begin(); y != rows.end(); ++y) {
        for (int x = 0; x <= width; ++x) {
          probes[static_cast<size_t>(y) * (width + 1) + x] = ProbeAt(x, y);
        }
      }
    });
    return probes;
  }

  // All four corners of a pixel on one face, in full sun or in full shadow; or in the sky.
  static bool IsUniform(const Probe* top, const Probe* bottom) {
    return top[0] == top[1] && top[0] == bottom[0] && top[0] == bottom[1] &&
           (top[0].sun_bits == 0 || top[0].sun_bits == 15);
  }

  PixelRays RaysOf(int x, int y) const {
    const Eigen::Matrix3d world_from_cam = camera_.cam_from_world.rotation.transpose();
    PixelRays rays;
    rays.origin = origin_;
    rays.corner = world_from_cam * UnprojectToCam(camera_, Eigen::Vector2d(x, y));
    rays.step_x = world_from_cam * UnprojectToCam(camera_, Eigen::Vector2d(x + 1, y)) - rays.corner;
    rays.step_y = world_from_cam * UnprojectToCam(camera_, Eigen::Vector2d(x, y + 1)) - rays.corner;
    return rays;
  }

  Probe ProbeAt(int x, int y) const {
    const Eigen::Vector3d direction = UnprojectToWorld(camera_, Eigen::Vector2d(x, y));
    const auto hit = scene_.visibility.FirstHit(origin_, direction);
    if (!hit) return {};
    Probe probe{hit->face, 0};
    if (!scene_.light.is_sunny || !shader_.FacesSun(hit->face, direction)) return probe;
    const Eigen::Vector3d point =
        shader_.LiftedPoint(hit->face, origin_ + hit->distance * direction, direction);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d to_rim = sun_.Toward(1, i * std::numbers::pi / 2);
      if (!scene_.visibility.FirstHit(point, to_rim))
        probe.sun_bits |= static_cast<uint8_t>(1 << i);
    }
    return probe;
  }

  // One face, evenly in sun or in shadow: four filtered texture samples, no more rays.
  Rgb UniformPixel(const PixelRays& rays, const Probe& probe) const {
    if (probe.face == kSky) return SkyRadiance(scene_.light, rays.Direction(0.5, 0.5));
    Rgb sum = Rgb::Zero();
    for (int i = 0; i < 4; ++i) {
      const int column = i % 2;
      const int row = i / 2;
      const Eigen::Vector3d direction = rays.Direction(0.25 + 0.5 * column, 0.25 + 0.5 * row);
      sum += shader_.Shade(rays,
                           probe.face,
                           direction,
                           shader_.DistanceAlong(probe.face, direction),
                           probe.sun_bits != 0,
                           0.5);
    }
    return sum / 4;
  }

  // A ray in each cell of a grid, 4 x 4 for 16.
  Rgb MixedPixel(const PixelRays& rays, int x, int y) const {
    Rgb sum = Rgb::Zero();
    for (int i = 0; i < cells_ * cells_; ++i) {
      const uint64_t hash = HashOf(seed_, x, y, i);
      const int row = i / cells_;
      const Eigen::Vector3d direction = rays.Direction((i % cells_ + UniformOf(hash)) / cells_,
                                                       (row + UniformOf(HashOf(hash))) / cells_);
      const auto hit = scene_.visibility.FirstHit(origin_, direction);
      if (!hit) {
        sum += SkyRadiance(scene_.light, direction);
        continue;
      }
      bool in_sun = false;
      if (scene_.light.is_sunny && shader_.FacesSun(hit->face, direction)) {
        const Eigen::Vector3d point =
            shader_.LiftedPoint(hit->face, origin_ + hit->distance * direction, direction);
        const double radius = std::sqrt(UniformOf(HashOf(hash, 1)));
        const double angle = 2 * std::numbers::pi * UniformOf(HashOf(hash, 2));
        in_sun = !scene_.visibility.FirstHit(point, sun_.Toward(radius, angle));
      }
      sum += shader_.Shade(rays, hit->face, direction, hit->distance, in_sun, 1.0 / cells_);
    }
    return sum / (cells_ * cells_);
  }

  const RayScene& scene_;
  const Camera& camera_;
  uint64_t seed_;
  SunDisc sun_;
  int cells_;  // of a mixed pixel, each way
  Eigen::Vector3d origin_;
  SurfaceShader shader_;
};

}  // namespace

ImageF RenderRadiance(const RayScene& scene, const Camera& camera, uint64_t seed) {
  return PathTracer(scene, camera, seed).Render();
}

}  // namespace groundglass
