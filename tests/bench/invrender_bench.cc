// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "invrender/photos/face_mask.h"
#include "invrender/photos/photo_pyramid.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <ctime>
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

// CPU seconds of the process so far.
double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The least that any bake can do: decode the photographs, look as many texels up bilinearly with
// cv::remap, and encode the page as JPEG. The counter is the bake's time over this, in one run.
void BM_BakeBrickOverFloor(benchmark::State& state) {
  const PolygonModel model = ReadOsu(kBrick + "/model.osu").model;
  const std::vector<BakePhotograph> photographs = BrickPhotographs();
  double bake_seconds = 0;
  double floor_seconds = 0;
  for (auto _ : state) {
    const double start = CpuSeconds();
    const BakeResult result = BakeTextures(model, photographs);
    for (const TexturePage& page : result.model.pages) EncodeImage(page.srgb8, ".jpg");
    const double middle = CpuSeconds();
    long num_texels = 0;
    for (const FaceCoverage& face : result.coverage.faces) num_texels += face.num_covered_texels;
    const int side = 1024;
    const int num_tiles = static_cast<int>(num_texels / (side * side)) + 1;
    cv::Mat map(side, side, CV_32FC2);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        map.at<cv::Vec2f>(y, x) = {0.7f * static_cast<float>(x) + 0.1f * static_cast<float>(y),
                                   0.7f * static_cast<float>(y)};
      }
    }
    std::vector<Image8> decoded;
    for (const BakePhotograph& photograph : photographs) {
      decoded.push_back(ReadSrgb8(photograph.image_file));
    }
    for (int tile = 0; tile < num_tiles; ++tile) {
      Image8& from = decoded[tile % decoded.size()];
      cv::Mat to;
      cv::remap(cv::Mat(from.height, from.width, CV_8UC3, from.values.data()),
                to,
                map,
                {},
                cv::INTER_LINEAR);
      benchmark::DoNotOptimize(to.data);
    }
    for (const TexturePage& page : result.model.pages) EncodeImage(page.srgb8, ".jpg");
    floor_seconds += CpuSeconds() - middle;
    bake_seconds += middle - start;
  }
  state.counters["times_the_floor"] = bake_seconds / floor_seconds;
  state.counters["floor_s"] = floor_seconds / static_cast<double>(state.iterations());
}
BENCHMARK(BM_BakeBrickOverFloor)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

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
