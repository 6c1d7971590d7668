// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/daylight.h"
#include "datasets-synthetic/notebook.h"
#include "datasets-synthetic/recipe.h"
#include "datasets-synthetic/slide.h"
#include "scene/camera.h"

#include <string>

namespace groundglass {

// Everything about one photograph that chance or plan has decided, before a ray is shot.
struct PhotographPlan {
  std::string name;
  std::string comment;
  NotebookEntry entry;
  SlideTransform slide;
  Photometry photometry;
  Daylight light;
  double sun_azimuth_deg = 0;
  double sun_elevation_deg = 0;
  int num_specks = 0;
  int num_scratches = 0;
  Blunder blunder = Blunder::kNone;  // in the tag
  Camera camera;                     // the scan's: the slide's transform folded in
  Camera written_camera;             // the picture's as written: resampled if it went through video
};

// The file of a photograph in images/: JPEG, or TIFF for 16 bits.
std::string PictureFileName(const PhotographPlan& plan, const SynthRecipe& recipe);

// Draws what the recipe leaves to chance for the `index`-th photograph of its seed.
PhotographPlan PlanPhotograph(const PlannedView& view, const SynthRecipe& recipe, int index);

}  // namespace groundglass
