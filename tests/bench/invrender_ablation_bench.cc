// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What each part of inverse rendering is worth: the novel views of a scene with known truth, drawn
// from textures that were baked with all parts, and with one of them left out.
#include "evaluate/evaluate.h"
#include "invrender/bake.h"
#include "invrender/bake_output.h"
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "viewer/renderer.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

struct Variant {
  std::string name;
  BakeOptions options;
};

// Stages that leave things as they are, or do them more simply.
std::vector<float> BelieveAll(const ChartBlocks& blocks,
                              int,
                              const ColourModel&,
                              const ConsistencyOptions&) {
  return std::vector<float>(blocks.views.size(), 1);
}
ColourModel KeepColours(const std::vector<ChartBlocks>& blocks,
                        size_t num_photos,
                        const ColourOptions&) {
  return MakeNeutralColour(blocks, num_photos);
}
// The photograph that shows most of a chart, wherever it shows it, as in the thesis.
ChartChoice OneForEachChart(const ChartBlocks& blocks, std::vector<float> consistency) {
  std::vector<double> shown(blocks.photos.size(), 0);
  for (size_t i = 0; i < blocks.views.size(); ++i) {
    shown[i % shown.size()] += blocks.views[i].quality * consistency[i];
  }
  ChartChoice choice = ChooseBlocks(blocks, std::move(consistency));
  const auto best = static_cast<int>(std::max_element(shown.begin(), shown.end()) - shown.begin());
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    if (choice.best[block] >= 0 && blocks.ViewsOf(block)[best].quality > 0) {
      choice.best[block] = best;
    }
  }
  return choice;
}

std::vector<Variant> MakeVariants() {
  std::vector<Variant> variants;
  const auto add = [&](const std::string& name) -> BakeOptions& {
    return variants.emplace_back(Variant{name, {}}).options;
  };
  add("everything");
  // Occluders are still told by matched colours.
  add("photographs' own colours").match_colour = false;
  add("no colours matched at all").stages.estimate_colour = KeepColours;
  add("no consensus").stages.measure_consistency = BelieveAll;
  BakeOptions& neither = add("neither");
  neither.match_colour = false;
  neither.stages.measure_consistency = BelieveAll;
  add("all photographs as sharp").stages.measure_sharpness = [](auto&&...) {
    return std::vector<Sharpness>();
  };
  add("grain").stages.smooth_grain = [](auto&&...) {};
  add("one photograph for a chart").stages.choose_blocks = OneForEachChart;
  add("seams where they fall").stages.smooth_seams = [](auto&&...) {};
  BakeOptions& hard = add("hard seams where they fall");
  hard.stages.smooth_seams = [](auto&&...) {};
  hard.blend.across_seams = false;
  add("no margin at borders").photos.border_margin_px = 0;
  add("no search for mounts").photos.detect_mount = false;
  add("gaps painted over").fill_gaps = true;
  return variants;
}

int Run(const std::string& folder) {
  const Scene scene = ReadScene(folder);
  const Truth truth = ReadTruth(scene.folder / "truth");
  const std::vector<BakePhotograph> photographs = SelectPhotographs(scene, truth.cameras);
  std::printf("%-28s %9s %8s %9s\n", "", "PSNR, dB", "SSIM", "coverage");
  for (const Variant& variant : MakeVariants()) {
    const BakeResult bake = BakeTextures(scene.model, photographs, variant.options);
    PictureErrors mean;
    for (const NovelView& view : truth.novel_views) {
      const Image8 true_srgb8 = ReadSrgb8(view.image_file);
      const Camera camera = CameraFromTag(view.tag, true_srgb8.width, true_srgb8.height);
      RenderOptions render_options;
      render_options.supersampling = 2;
      render_options.background = Background::kTransparent;
      const PictureErrors errors = ComparePictures(true_srgb8,
                                                   Render(bake.model, camera, render_options),
                                                   ReadLabels(view.faces_file),
                                                   CoveredPixels(bake.model, camera));
      const auto share = 1.0 / static_cast<double>(truth.novel_views.size());
      mean.psnr_db += share * errors.psnr_db;
      mean.ssim += share * errors.ssim;
      mean.coverage += share * errors.coverage;
    }
    std::printf("%-28s %9.2f %8.4f %8.2f%%\n",
                variant.name.c_str(),
                mean.psnr_db,
                mean.ssim,
                100 * mean.coverage);
  }
  return 0;
}

}  // namespace
}  // namespace groundglass

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: invrender_ablation_bench SCENE\n");
    return 2;
  }
  try {
    return groundglass::Run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "invrender_ablation_bench: %s\n", error.what());
    return 1;
  }
}
