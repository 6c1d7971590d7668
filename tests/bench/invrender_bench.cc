// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/invrender.h"
#include "invrender/photo_pyramid.h"
#include "scene/colmap_io.h"
#include "scene/osu_io.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {
namespace {

const std::string kBrick = std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick";

std::vector<BakePhotograph> BrickPhotographs() {
  std::vector<BakePhotograph> photographs;
  for (const NamedCamera& named : ReadColmapModel(kBrick + "/truth/cameras")) {
    BakePhotograph& photograph = photographs.emplace_back();
    photograph.name = std::filesystem::path(named.name).stem().string();
    photograph.image_file = kBrick + "/images/" + named.name;
    photograph.camera = named.camera;
  }
  return photographs;
}

// Twelve photographs of 1200 x 800, decoding included; texels per second.
void BM_BakeBrick(benchmark::State& state) {
  const PolygonModel model = ReadOsu(kBrick + "/model.osu").model;
  const std::vector<BakePhotograph> photographs = BrickPhotographs();
  double num_texels = 0;
  for (auto _ : state) {
    const BakeResult result = BakeTextures(model, photographs);
    for (const FaceCoverage& face : result.coverage.faces) {
      num_texels += static_cast<double>(face.num_covered_texels);
    }
  }
  state.counters["texels"] = benchmark::Counter(num_texels, benchmark::Counter::kIsRate);
}
BENCHMARK(BM_BakeBrick)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

// The automatic mask of one photograph; pixels per second.
void BM_FaceMask(benchmark::State& state) {
  const PolygonModel model = ReadOsu(kBrick + "/model.osu").model;
  const Visibility visibility(model);
  const int scale = static_cast<int>(state.range(0));
  const Camera small = BrickPhotographs()[0].camera;
  const Camera camera = ResizedCamera(small, scale * small.width_px, scale * small.height_px);
  for (auto _ : state) benchmark::DoNotOptimize(MakeFaceMask(model, visibility, camera));
  state.counters["pixels"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * camera.width_px * camera.height_px,
      benchmark::Counter::kIsRate);
}
BENCHMARK(BM_FaceMask)->Arg(1)->Arg(5)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

// One lookup; the argument is the footprint's side in tenths of a pixel.
void BM_Sample(benchmark::State& state) {
  const PhotoPyramid pyramid(Image8(1200, 800, 3, 90));
  const Eigen::Matrix2d footprint =
      Eigen::Matrix2d::Identity() * static_cast<double>(state.range(0)) / 10;
  double x = 10;
  for (auto _ : state) {
    benchmark::DoNotOptimize(pyramid.Sample({x, 400.3}, footprint));
    x = x < 1180 ? x + 0.37 : 10;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_Sample)->Arg(8)->Arg(16)->Arg(40)->Arg(160);

}  // namespace
}  // namespace groundglass

BENCHMARK_MAIN();
