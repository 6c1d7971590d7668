// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/noise.h"

#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

void AddGround(WorldBuilder& builder,
               const Eigen::Vector2d& low,
               const Eigen::Vector2d& high,
               double height,
               Material material,
               const Rgb& color,
               const std::string& name) {
  builder.AddPolygon({{low.x(), low.y(), height},
                      {high.x(), low.y(), height},
                      {high.x(), high.y(), height},
                      {low.x(), high.y(), height}},
                     material,
                     color,
                     name);
}

}  // namespace

void AddSurroundings(WorldBuilder& builder,
                     const Eigen::Vector2d& center,
                     double radius,
                     uint64_t seed) {
  const Eigen::Vector2d plaza(radius, radius);
  const Eigen::Vector2d far(4000, 4000);
  // Layers lie a little above one another, so that a ray meets the upper one.
  AddGround(builder,
            center - far,
            center + far,
            kLawnHeight,
            Material::kGrass,
            {0.09f, 0.13f, 0.04f},
            "lawn");
  AddGround(builder,
            center - plaza,
            center + plaza,
            0,
            Material::kPaving,
            {0.36f, 0.34f, 0.31f},
            kPlazaName);
  // The plaza's kerb.
  for (int side = 0; side < 4; ++side) {
    const Eigen::Vector2d corners[4] = {center + Eigen::Vector2d(-radius, -radius),
                                        center + Eigen::Vector2d(radius, -radius),
                                        center + Eigen::Vector2d(radius, radius),
                                        center + Eigen::Vector2d(-radius, radius)};
    builder.AddWall(corners[side],
                    corners[(side + 1) % 4],
                    {{kLawnHeight, 0, Material::kConcrete, Rgb(0.4f, 0.4f, 0.38f), ""}},
                    "kerb");
  }
  const double street = radius + 40;
  AddGround(builder,
            center + Eigen::Vector2d(-4000, -street - 36),
            center + Eigen::Vector2d(4000, -street),
            -0.5,
            Material::kAsphalt,
            {0.07f, 0.07f, 0.072f},
            "street");
  AddGround(builder,
            center + Eigen::Vector2d(-4000, -street - 19),
            center + Eigen::Vector2d(4000, -street - 18),
            -0.45,
            Material::kPlain,
            {0.55f, 0.55f, 0.5f},
            "street line");
  // Blocks in the distance, beyond everyone who photographs.
  const Rgb colors[5] = {{0.22f, 0.11f, 0.08f},
                         {0.35f, 0.31f, 0.25f},
                         {0.3f, 0.17f, 0.12f},
                         {0.4f, 0.39f, 0.37f},
                         {0.2f, 0.2f, 0.2f}};
  constexpr int kNumBlocks = 34;
  for (int i = 0; i < kNumBlocks; ++i) {
    const auto draw = [&](const char* what) { return UniformOf(SeedFor(seed, what, i)); };
    const double angle = 2 * std::numbers::pi * (i + 0.6 * draw("block angle")) / kNumBlocks;
    const double distance = radius + 330 + 500 * draw("block distance");
    const Eigen::Vector2d middle =
        center + distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d half(30 + 60 * draw("block width"), 25 + 40 * draw("block depth"));
    const double height =
        12.5 * std::floor(2 + 6 * draw("block height") * draw("block storeys")) + 4;
    builder.AddBox({middle.x() - half.x(), middle.y() - half.y(), -0.6},
                   {middle.x() + half.x(), middle.y() + half.y(), height},
                   Material::kFacade,
                   Material::kRoof,
                   colors[static_cast<int>(draw("block color") * 5) % 5],
                   "block " + std::to_string(i + 1));
  }
}

}  // namespace groundglass
