// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/recipe.h"
#include "scene/image.h"
#include "scene/progress.h"

#include <filesystem>

namespace groundglass {

struct SynthSummary {
  int num_faces = 0;
  int num_photographs = 0;
  int num_novel_views = 0;
  int num_april_tags = 0;        // on the building's walls
  int num_blunders = 0;          // among the hand tags
  double mean_tag_error_px = 0;  // the others' mean vertex error
};

// Makes a scene with known answers and writes it as a scene folder with its truth: model.osu,
// views/, images/, truth/, recipe.json, and apriltags.csv where tags hang. The folder is made; it
// must be empty or not be there. Throws Error.
SynthSummary WriteSyntheticScene(const SynthRecipe& recipe,
                                 const std::filesystem::path& folder,
                                 const Progress& progress = {});

// A picture of what a recipe makes: its first photograph without those who pass, sRGB.
Image8 RenderPresetPicture(const SynthRecipe& recipe);

}  // namespace groundglass
