// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_photograph.h"
#include "scene/image_io.h"
#include "scene/osu_io.h"
#include "scene/view_io.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <filesystem>

// Times on the brick scene's slide s3 (1200x800). The reference is OpenCV's Canny detector on the
// same photograph: what it costs to find edges at all. Quote ratios to it, not seconds.

namespace groundglass {
namespace {

struct Slide {
  PolygonModel model;
  ViewTag tag;
  Image8 grey8;
};

const Slide& BrickSlide() {
  static const Slide slide = [] {
    const std::filesystem::path folder =
        std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
    return Slide{ReadOsu(folder / "model.osu").model,
                 ReadView(folder / "views/s3.view"),
                 ReadGrey8(folder / "images/s3.jpg")};
  }();
  return slide;
}

void BM_ReferenceCanny(benchmark::State& state) {
  const Slide& slide = BrickSlide();
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
BENCHMARK(BM_ReferenceCanny)->Unit(benchmark::kMillisecond);

void BM_EdgeEvidence(benchmark::State& state) {
  const Slide& slide = BrickSlide();
  for (auto _ : state) benchmark::DoNotOptimize(EdgeEvidence(slide.grey8, {}));
}
BENCHMARK(BM_EdgeEvidence)->Unit(benchmark::kMillisecond);

void BM_SampleVisibleEdges(benchmark::State& state) {
  const Slide& slide = BrickSlide();
  const EdgeModel edge_model(slide.model);
  const Camera camera = CameraFromTag(slide.tag, slide.grey8.width, slide.grey8.height);
  for (auto _ : state) benchmark::DoNotOptimize(SampleVisibleEdges(edge_model, camera, -3, 4));
}
BENCHMARK(BM_SampleVisibleEdges)->Unit(benchmark::kMillisecond);

void BM_FindHypotheses(benchmark::State& state) {
  const Slide& slide = BrickSlide();
  const int width = slide.grey8.width;
  const int height = slide.grey8.height;
  const EdgeModel edge_model(slide.model);
  const EdgeEvidence evidence(slide.grey8, {});
  const CameraPrior prior = MakeCameraPrior(slide.tag, slide.model.unit, {}, {});
  const std::vector<EdgeSample> samples =
      SampleVisibleEdges(edge_model, CameraFromTag(slide.tag, width, height), 0.02 * width, 10);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        FindHypotheses(samples, prior, slide.tag, width, height, evidence, {}));
  }
}
BENCHMARK(BM_FindHypotheses)->Unit(benchmark::kMillisecond);

void BM_RefineFromTag(benchmark::State& state) {
  const Slide& slide = BrickSlide();
  const EdgeModel edge_model(slide.model);
  const EdgeEvidence evidence(slide.grey8, {});
  const CameraPrior prior = MakeCameraPrior(slide.tag, slide.model.unit, {}, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(RefineFrom(CameraParameters::Zero(),
                                        edge_model,
                                        evidence,
                                        prior,
                                        slide.tag,
                                        slide.grey8.width,
                                        slide.grey8.height,
                                        {}));
  }
}
BENCHMARK(BM_RefineFromTag)->Unit(benchmark::kMillisecond);

void BM_RegisterPhotograph(benchmark::State& state) {
  const Slide& slide = BrickSlide();
  const EdgeModel edge_model(slide.model);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        RegisterPhotograph("s3", slide.grey8, {}, slide.tag, {}, edge_model, {}));
  }
}
BENCHMARK(BM_RegisterPhotograph)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace groundglass

BENCHMARK_MAIN();
