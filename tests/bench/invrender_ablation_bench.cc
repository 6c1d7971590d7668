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

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace groundglass {
namespace {

struct Variant {
  std::string name;
  BakeOptions options;
};

std::vector<Variant> MakeVariants() {
  std::vector<Variant> variants;
  variants.push_back({"everything", {}});
  variants.push_back({"photographs' own colours", {}});
  variants.back().options.match_colour = false;
  variants.push_back({"no consensus", {}});
  variants.back().options.reject_occluders = false;
  variants.push_back({"neither", {}});
  variants.back().options.match_colour = false;
  variants.back().options.reject_occluders = false;
  variants.push_back({"all photographs as sharp", {}});
  variants.back().options.judge_sharpness = false;
  variants.push_back({"grain", {}});
  variants.back().options.smooth_grain = false;
  variants.push_back({"hard seams where they fall", {}});
  variants.back().options.smooth_seams = false;
  variants.push_back({"no margin at borders", {}});
  variants.back().options.border_margin_px = 0;
  variants.push_back({"no search for mounts", {}});
  variants.back().options.detect_mount = false;
  variants.push_back({"gaps painted over", {}});
  variants.back().options.fill_gaps = true;
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
