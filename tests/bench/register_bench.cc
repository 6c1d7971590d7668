// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine_set.h"
#include "register/register.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <map>

// Times on the brick scene's slide s3 (1200x800), at its own size and resampled to others: 640 px
// wide, 1500, and 6000, which are 24 megapixels. Decoding is apart. The reference is OpenCV's Canny
// detector on the same picture: what it costs to find edges at all. Quote ratios to it, not
// seconds. All threads' CPU time counts.

namespace groundglass {
namespace {

struct Slide {
  PolygonModel model;
  ViewTag tag;
  Image8 grey8;
};

const Slide& BrickSlide(int width_px) {
  static std::map<int, Slide> slides;
  Slide& slide = slides[width_px];
  if (!slide.grey8.Empty()) return slide;
  const std::filesystem::path folder =
      std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
  slide.model = ReadOsu(folder / "model.osu").model;
  slide.tag = ReadView(folder / "views/s3.view");
  slide.grey8 = ReadGrey8(folder / "images/s3.jpg");
  if (width_px != slide.grey8.width) {
    const cv::Mat from(slide.grey8.height, slide.grey8.width, CV_8UC1, slide.grey8.values.data());
    Image8 resampled(width_px, width_px * slide.grey8.height / slide.grey8.width, 1);
    cv::Mat to(resampled.height, resampled.width, CV_8UC1, resampled.values.data());
    const bool is_smaller = width_px < slide.grey8.width;
    cv::resize(from, to, to.size(), 0, 0, is_smaller ? cv::INTER_AREA : cv::INTER_CUBIC);
    slide.grey8 = std::move(resampled);
  }
  return slide;
}

void AtAllWidths(benchmark::internal::Benchmark* bench) {
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->ArgName("width");
  for (const int width_px : {640, 1200, 1500}) bench->Arg(width_px);
}

void BM_ReferenceCanny(benchmark::State& state) {
  const Slide& slide = BrickSlide(static_cast<int>(state.range(0)));
  const cv::Mat grey(slide.grey8.height,
                     slide.grey8.width,
                     CV_8UC1,
                     const_cast<uint8_t*>(slide.grey8.values.data()));
  cv::setNumThreads(1);
  for (auto _ : state) {
    cv::Mat smooth;
    cv::Mat edges;
    cv::GaussianBlur(grey, smooth, {0, 0}, 1.0);
    cv::Canny(smooth, edges, 40, 100);
    benchmark::DoNotOptimize(edges.data);
  }
}
BENCHMARK(BM_ReferenceCanny)->Apply(AtAllWidths)->Arg(6000);

void BM_EdgeEvidence(benchmark::State& state) {
  const Slide& slide = BrickSlide(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(EdgeEvidence(slide.grey8, {}));
}
BENCHMARK(BM_EdgeEvidence)->Apply(AtAllWidths);

CameraPrior PriorOf(const Slide& slide) {
  return MakeCameraPrior(
      slide.tag, slide.grey8.width, slide.grey8.height, slide.model.unit, {}, {});
}

void BM_SampleVisibleEdges(benchmark::State& state) {
  const Slide& slide = BrickSlide(static_cast<int>(state.range(0)));
  const EdgeModel edge_model(slide.model);
  const Camera camera = CameraFromTag(slide.tag, slide.grey8.width, slide.grey8.height);
  for (auto _ : state) benchmark::DoNotOptimize(SampleVisibleEdges(edge_model, camera, -3, 4));
}
BENCHMARK(BM_SampleVisibleEdges)->Apply(AtAllWidths);

void BM_FindHypotheses(benchmark::State& state) {
  const Slide& slide = BrickSlide(static_cast<int>(state.range(0)));
  const EdgeModel edge_model(slide.model);
  const EdgeEvidence evidence(slide.grey8, {});
  const CameraPrior prior = PriorOf(slide);
  const std::vector<EdgeSample> samples = SampleVisibleEdges(
      edge_model, prior.CameraAt(CameraParameters::Zero()), 0.02 * prior.width_px, 10);
  for (auto _ : state) benchmark::DoNotOptimize(FindHypotheses(samples, prior, evidence, {}));
}
BENCHMARK(BM_FindHypotheses)->Apply(AtAllWidths);

void BM_RefineFromTag(benchmark::State& state) {
  const Slide& slide = BrickSlide(static_cast<int>(state.range(0)));
  const EdgeModel edge_model(slide.model);
  const EdgeEvidence evidence(slide.grey8, {});
  const CameraPrior prior = PriorOf(slide);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        RefinePhotograph(CameraParameters::Zero(), edge_model, evidence, prior, {}));
  }
}
BENCHMARK(BM_RefineFromTag)->Apply(AtAllWidths);

void BM_ScoreAlignment(benchmark::State& state) {
  const Slide& slide = BrickSlide(static_cast<int>(state.range(0)));
  const EdgeModel edge_model(slide.model);
  const EdgeEvidence evidence(slide.grey8, {});
  const Camera camera = CameraFromTag(slide.tag, slide.grey8.width, slide.grey8.height);
  const std::vector<EdgeSample> samples = SampleVisibleEdges(edge_model, camera, -3, 4);
  const ParameterProjection projection(
      ParametersFromTag(slide.tag), {.k2 = slide.tag.k2}, slide.grey8.width, slide.grey8.height);
  for (auto _ : state) {
    benchmark::DoNotOptimize(ScoreAlignment(samples, projection, evidence, {}));
  }
}
BENCHMARK(BM_ScoreAlignment)->Apply(AtAllWidths);

// A photograph from its tag, all of it but decoding.
void BM_RegisterPhotograph(benchmark::State& state) {
  const Slide& slide = BrickSlide(static_cast<int>(state.range(0)));
  const EdgeModel edge_model(slide.model);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        RegisterPhotograph({"s3", slide.grey8, {}, slide.tag, {}}, edge_model, {}));
  }
}
BENCHMARK(BM_RegisterPhotograph)->Apply(AtAllWidths)->Arg(6000);

// The dozen slides of the scene, at their own size, once each is aligned by itself.
void BM_RefineSet(benchmark::State& state) {
  const Scene scene =
      ReadScene(std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick");
  const EdgeModel edge_model(scene.model);
  std::vector<PhotographAlignment> aligned;
  for (const Photograph& photograph : scene.photographs) {
    aligned.push_back(
        AlignPhotograph({photograph.name, ReadGrey8(photograph.image_file), {}, photograph.tag, {}},
                        edge_model,
                        {}));
  }
  for (auto _ : state) {
    std::vector<PhotographAlignment> together = aligned;
    benchmark::DoNotOptimize(RefineSet(edge_model, {}, together));
  }
}
BENCHMARK(BM_RefineSet)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace groundglass

BENCHMARK_MAIN();
