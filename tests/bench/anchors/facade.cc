// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/facade.h"

#include "datasets-synthetic/synth.h"
#include "evaluate/truth.h"
#include "scene/formats/scene_folder.h"
#include "tests/support/temporary_folder.h"

namespace groundglass {

AnchorSet MakeFacade(double relief) {
  SynthRecipe recipe = PresetRecipe("wiesner");
  recipe.width_px = 640;
  recipe.height_px = 427;
  recipe.relief = relief;
  recipe.surface_texel = 10;  // not needed
  recipe.slide.sigma_shift = recipe.slide.sigma_turn_deg = 0;
  recipe.slide.sigma_scale = recipe.slide.sigma_anisotropy = 0;
  const TemporaryFolder folder;
  WriteSyntheticScene(recipe, folder / "facade");
  const Scene scene = ReadScene(folder / "facade");
  AnchorSet set;
  set.name = relief > 0 ? "facade with relief" : "facade";
  set.model = scene.model;
  const Truth truth = ReadTruth(folder / "facade" / "truth");
  for (size_t i = 0; i < truth.cameras.size(); ++i) {
    const ViewTag& written = scene.photographs[i].tag;
    const double distance = (written.lookat_in_site - written.position_in_site).norm();
    set.frames.push_back({ReadGrey8(scene.photographs[i].image_file),
                          TagFromCamera(truth.cameras[i].camera, distance)});
  }
  return set;
}

}  // namespace groundglass
