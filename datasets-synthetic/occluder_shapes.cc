// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/occluder_shapes.h"

#include "datasets-synthetic/lettering.h"
#include "datasets-synthetic/occluders.h"

namespace groundglass {

void AddLoft(WorldBuilder& builder,
             const std::vector<Ring>& rings,
             int num_sides,
             const Finish& finish) {
  const auto rim = [&](const Ring& ring, int i) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * i / num_sides;
    return ring.center + std::cos(angle) * ring.across + std::sin(angle) * ring.other;
  };
  for (size_t k = 0; k + 1 < rings.size(); ++k) {
    for (int i = 0; i < num_sides; ++i) {
      const Eigen::Vector3d a = rim(rings[k], i);
      const Eigen::Vector3d b = rim(rings[k], i + 1);
      const Eigen::Vector3d c = rim(rings[k + 1], i + 1);
      const Eigen::Vector3d d = rim(rings[k + 1], i);
      // Two triangles: between ovals of different shape the four do not lie in a plane.
      if ((b - a).norm() > 1e-3) {
        builder.AddPolygon({a, b, c}, finish.material, finish.color, finish.name, finish.mask_code);
      }
      if ((d - c).norm() > 1e-3) {
        builder.AddPolygon({a, c, d}, finish.material, finish.color, finish.name, finish.mask_code);
      }
    }
  }
}

void AddEgg(WorldBuilder& builder,
            const Eigen::Vector3d& center,
            const Eigen::Vector3d& ahead,
            const Eigen::Vector3d& aside,
            const Eigen::Vector3d& up,
            int num_sides,
            const Finish& finish) {
  std::vector<Ring> rings;
  const int num_rings = num_sides / 2;
  for (int i = 0; i <= num_rings; ++i) {
    const double angle = std::numbers::pi * i / num_rings;
    const double width = i == 0 || i == num_rings ? 0 : std::sin(angle);
    rings.push_back({center - std::cos(angle) * up, width * ahead, width * aside});
  }
  AddLoft(builder, rings, num_sides, finish);
}

void AddLamp(WorldBuilder& builder, const Eigen::Vector2d& place) {
  builder.AddContactShadow(
      {.center = place, .half_length = 0.4, .half_width = 0.4, .reach = 1, .strength = 0.4});
  const Finish iron{Material::kPlain, Rgb(0.05f, 0.055f, 0.055f), "lamp post", kLamp};
  const Finish globe{Material::kPlain, Rgb(0.8f, 0.8f, 0.77f), "lamp globe", kLamp};
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const auto at = [&](double height) { return Eigen::Vector3d(place.x(), place.y(), height); };
  const auto ring = [&](double height, double radius) {
    return Ring{at(height), radius * x, radius * y};
  };
  AddLoft(builder,
          {ring(-0.6, 0.55),
           ring(0.25, 0.55),
           ring(0.3, 0.42),
           ring(1.1, 0.38),
           ring(1.2, 0.26),
           ring(1.6, 0.26),
           ring(12.9, 0.18),
           ring(12.95, 0.3),
           ring(13.15, 0.34),
           ring(13.4, 0.5),
           ring(13.45, 0)},
          12,
          iron);
  AddEgg(builder, at(14.2), 0.95 * x, 0.95 * y, {0, 0, 0.95}, 20, globe);
  AddLoft(
      builder, {ring(15.05, 0.32), ring(15.2, 0.28), ring(15.45, 0.06), ring(15.6, 0)}, 12, iron);
}

void AddSign(WorldBuilder& builder,
             const Eigen::Vector2d& place,
             const Eigen::Vector2d& toward,
             int number) {
  const Eigen::Vector2d facing = (toward - place).normalized();
  const Eigen::Vector2d along(-facing.y(), facing.x());
  const Eigen::Vector2d left = place - 3.5 * along;
  const Eigen::Vector2d right = place + 3.5 * along;
  const Rgb paint = number % 2 == 0 ? Rgb(0.03f, 0.08f, 0.25f) : Rgb(0.25f, 0.04f, 0.04f);
  const Rgb white(0.75f, 0.75f, 0.7f);
  const char* text[3] = {"VISITORS >", "NO PARKING", "DELIVERIES"};
  const auto board =
      [&](double out, double from, double to, double low, double high, const Rgb& color) {
        const auto at = [&](double s, double height) {
          const Eigen::Vector2d p = left + s * along + out * facing;
          return Eigen::Vector3d(p.x(), p.y(), height);
        };
        std::vector<Eigen::Vector3d> corners = {
            at(from, low), at(to, low), at(to, high), at(from, high)};
        return builder.AddPolygon(corners, Material::kPlain, color, "sign", kSign);
      };
  // The back is bare metal, the front painted with a white line along its border.
  board(-0.1, 7, 0, 3.2, 6.4, Rgb(0.3f, 0.3f, 0.3f));
  const int face = board(0.1, 0, 7, 3.2, 6.4, paint);
  Surface& surface = builder.SurfaceOf(face);
  surface.decals.push_back(MakeDecal(
      MakeLettering(text[number % 3], white), surface.low_u + 0.5, 4.1, surface.high_u - 0.5, 5.5));
  board(0.12, 0.15, 6.85, 3.35, 3.45, white);
  board(0.12, 0.15, 6.85, 6.15, 6.25, white);
  board(0.12, 0.15, 0.25, 3.45, 6.15, white);
  board(0.12, 6.75, 6.85, 3.45, 6.15, white);
  for (const Eigen::Vector2d& post : {left, right}) {
    builder.AddTaperedColumn({post.x(), post.y(), -0.6},
                             {post.x(), post.y(), 6.6},
                             0.17,
                             0.17,
                             8,
                             Material::kPlain,
                             Rgb(0.1f, 0.1f, 0.1f),
                             "sign post",
                             kSign);
  }
}

}  // namespace groundglass
