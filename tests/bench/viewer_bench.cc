// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera.h"
#include "scene/textured_model.h"
#include "viewer/camera_path.h"
#include "viewer/renderer.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace groundglass {
namespace {

// A hall of 60 x 40 x 30 whose faces share one page of 4096 x 4096, each with a quarter of it, with
// fine stripes.
TexturedModel MakeHall() {
  constexpr int kPagePx = 4096;
  TexturedModel hall;
  for (const double z : {0.0, 30.0}) {
    hall.model.points_in_world.insert(hall.model.points_in_world.end(),
                                      {{0, 0, z}, {60, 0, z}, {60, 40, z}, {0, 40, z}});
  }
  hall.model.faces = {{{0, 1, 5, 4}, "south"},
                      {{1, 2, 6, 5}, "east"},
                      {{2, 3, 7, 6}, "north"},
                      {{3, 0, 4, 7}, "west"},
                      {{4, 5, 6, 7}, "roof"}};
  for (int face = 0; face < 5; ++face) {
    constexpr double kSize = kPagePx / 2.0;
    const int row = face / 2 % 2;
    const double x = face % 2 * kSize;
    const double y = row * kSize;
    hall.faces.push_back({0, {{x, y + kSize}, {x + kSize, y + kSize}, {x + kSize, y}, {x, y}}});
  }
  TexturePage page;
  page.srgb8 = Image8(kPagePx, kPagePx, 3);
  for (int y = 0; y < kPagePx; ++y) {
    for (int x = 0; x < kPagePx; ++x) {
      uint8_t* texel = page.srgb8.At(x, y);
      texel[0] = static_cast<uint8_t>(150 + 60 * (x / 16 % 2));
      texel[1] = static_cast<uint8_t>(80 + 40 * (y / 8 % 2));
      texel[2] = static_cast<uint8_t>((x * 7 + y * 13) % 90);
    }
  }
  hall.pages.push_back(std::move(page));
  return hall;
}

// Frames of an orbit at 1500 x 1000. Arguments: samples a pixel, texels along the line of sight,
// edges drawn over.
void BM_RenderTextured(benchmark::State& state) {
  const TexturedModel hall = MakeHall();
  Renderer renderer(hall);
  OrbitOptions orbit;
  orbit.width_px = 1500;
  orbit.height_px = 1000;
  const std::vector<Camera> cameras = MakeOrbit(hall.model, 36, orbit);
  RenderOptions options;
  options.background = Background::kSky;
  options.multisamples = static_cast<int>(state.range(0));
  options.anisotropy = static_cast<int>(state.range(1));
  options.edges = state.range(2) != 0;
  size_t frame = 0;
  renderer.Render(cameras.front(), options);  // makes the frame's buffers
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.Render(cameras[frame++ % cameras.size()], options));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_RenderTextured)
    ->ArgNames({"multisamples", "anisotropy", "edges"})
    ->Args({1, 1, 0})
    ->Args({4, 1, 0})
    ->Args({4, 1, 1})
    ->Args({4, 8, 0})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// From a textured model in memory to the first picture: upload and mipmaps.
void BM_LoadPage(benchmark::State& state) {
  const TexturedModel hall = MakeHall();
  const std::vector<Camera> cameras = MakeOrbit(hall.model, 1);
  for (auto _ : state) {
    Renderer renderer(hall);
    benchmark::DoNotOptimize(renderer.Render(cameras.front()));
  }
}
BENCHMARK(BM_LoadPage)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace groundglass

BENCHMARK_MAIN();
