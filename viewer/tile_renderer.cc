// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/tile_renderer.h"

#include "scene/error.h"
#include "scene/frames.h"
#include "scene/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

struct ScreenCorner {
  Eigen::Vector2f px;
  float nearness = 0;
  Eigen::Array3f code;
};
struct ScreenTile {
  std::array<ScreenCorner, 4> corners;
  int first_row = 0;
  int last_row = -1;  // before first_row: not in the picture
};

float Cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

ScreenTile ToScreen(const Camera& camera, const Tile& tile) {
  ScreenTile screen;
  float top = 1e30f;
  float bottom = -1e30f;
  float area = 0;
  for (int i = 0; i < 4; ++i) {
    const TileCorner& corner = tile.corners[i];
    const Eigen::Vector3d in_cam =
        camera.cam_from_world *
        WorldFromSite(Eigen::Vector3f(corner.x, corner.y, corner.z).cast<double>());
    const auto px = ProjectFromCam(camera, in_cam);
    if (!px) return {};
    screen.corners[i] = {
        px->cast<float>(), static_cast<float>(1 / in_cam.z()), {corner.r, corner.g, corner.b}};
    top = std::min(top, screen.corners[i].px.y());
    bottom = std::max(bottom, screen.corners[i].px.y());
  }
  for (int i = 0; i < 4; ++i) {
    area += Cross(screen.corners[i].px, screen.corners[(i + 1) % 4].px);
  }
  if (!(area > 0)) return {};  // its back
  screen.first_row = static_cast<int>(std::max(0.0f, std::ceil(top - 0.5f)));
  screen.last_row = static_cast<int>(std::min(camera.height_px - 1.0f, std::floor(bottom - 0.5f)));
  return screen;
}

// The part of a triangle in rows [first_row, last_row]. A sample on a side that two triangles
// share may be drawn by both.
void DrawTriangle(const ScreenCorner& a,
                  const ScreenCorner& b,
                  const ScreenCorner& c,
                  int first_row,
                  int last_row,
                  Image8& codes,
                  Raster<float>& nearness) {
  const float area = Cross(b.px - a.px, c.px - a.px);
  if (!(area > 0)) return;
  const float left = std::min({a.px.x(), b.px.x(), c.px.x()});
  const float right = std::max({a.px.x(), b.px.x(), c.px.x()});
  const int first = static_cast<int>(std::max(0.0f, std::ceil(left - 0.5f)));
  const int last = static_cast<int>(std::min(codes.width - 1.0f, std::floor(right - 0.5f)));
  for (int y = first_row; y <= last_row; ++y) {
    for (int x = first; x <= last; ++x) {
      const Eigen::Vector2f p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float of_a = Cross(b.px - p, c.px - p) / area;
      const float of_b = Cross(c.px - p, a.px - p) / area;
      const float of_c = 1 - of_a - of_b;
      if (of_a < 0 || of_b < 0 || of_c < 0) continue;
      const float near = of_a * a.nearness + of_b * b.nearness + of_c * c.nearness;
      if (near <= *nearness.At(x, y)) continue;
      *nearness.At(x, y) = near;
      const Eigen::Array3f code = of_a * a.code + of_b * b.code + of_c * c.code;
      for (int channel = 0; channel < 3; ++channel) {
        codes.At(x, y)[channel] =
            static_cast<uint8_t>(std::lround(255 * std::clamp(code[channel], 0.0f, 1.0f)));
      }
    }
  }
}

}  // namespace

TileRenderer::TileRenderer(const Camera& camera, int supersampling)
    : camera_(
          ResizedCamera(camera, supersampling * camera.width_px, supersampling * camera.height_px)),
      supersampling_(supersampling),
      codes_(camera_.width_px, camera_.height_px, 3, 255),
      nearness_(camera_.width_px, camera_.height_px, 1, 0) {
  if (supersampling < 1 || supersampling > 4) throw Error("supersampling must be from 1 to 4");
}

void TileRenderer::Draw(std::span<const Tile> tiles) {
  constexpr size_t kTilesAtOnce = 1 << 16;
  constexpr int kBands = 16;  // of rows: no two threads draw the same sample
  std::vector<ScreenTile> screen;
  for (size_t start = 0; start < tiles.size(); start += kTilesAtOnce) {
    const std::span<const Tile> some =
        tiles.subspan(start, std::min(kTilesAtOnce, tiles.size() - start));
    screen.resize(some.size());
    tbb::parallel_for(
        size_t{0}, some.size(), [&](size_t i) { screen[i] = ToScreen(camera_, some[i]); });
    tbb::parallel_for(0, kBands, [&](int band) {
      const int first_of_band = camera_.height_px * band / kBands;
      const int last_of_band = camera_.height_px * (band + 1) / kBands - 1;
      for (const ScreenTile& tile : screen) {
        const int first_row = std::max(tile.first_row, first_of_band);
        const int last_row = std::min(tile.last_row, last_of_band);
        if (first_row > last_row) continue;
        const auto& [a, b, c, d] = tile.corners;
        DrawTriangle(a, b, c, first_row, last_row, codes_, nearness_);
        DrawTriangle(a, c, d, first_row, last_row, codes_, nearness_);
      }
    });
  }
}

Image8 TileRenderer::Picture() const {
  const std::array<float, 256>& radiance = LinearOfSrgb8();
  Image8 picture(codes_.width / supersampling_, codes_.height / supersampling_, 3);
  const int num_samples = supersampling_ * supersampling_;
  tbb::parallel_for(0, picture.height, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int i = 0; i < num_samples; ++i) {
          sum += radiance[codes_.At(supersampling_ * x + i % supersampling_,
                                    supersampling_ * y + i / supersampling_)[c]];
        }
        const float mean = sum / static_cast<float>(num_samples);
        picture.At(x, y)[c] = Srgb8FromLinear(mean);
      }
    }
  });
  return picture;
}

}  // namespace groundglass
