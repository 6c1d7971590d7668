// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake_options.h"
#include "invrender/inputs/bake_photograph.h"
#include "scene/coverage.h"
#include "scene/polygon_model.h"
#include "scene/progress.h"
#include "scene/textured_model.h"

#include <span>
#include <string>
#include <vector>

// Inverse rendering: from photographs with their cameras to a textured model. The stages, in order,
// each on a floor of its own (a file includes its own floor and those above it here):
//
//   inputs/    BakePhotograph, and the options of each stage
//   charts/    MakeCharts        model                 -> faces in one plane that touch, each flat
//              PackCharts        charts                -> pages and each chart's place on them
//   photos/    PreparePhoto      photograph, model     -> what it shows of which face, how near to
//                                                         a border; its pyramid of pixels
//   measure/   ChooseTexelSizes  charts, photographs   -> a texel as fine as the best photograph
//              ObserveBlocks     charts, photographs   -> colour of each block in each photograph
//              SamplePatches     charts, photographs   -> fine detail, for sharpness and grain
//   colour/    EstimateColour    blocks                -> gains, vignetting, light of each face
//   select/    MeasureConsistency blocks, colour       -> who agrees with the consensus
//              ChooseBlocks      blocks, consistency   -> who shows each block
//              SmoothSeams       choice                -> the same, with seams that show less
//   compose/   ComposeChart      choice, photographs   -> texels, blended along seams
//              SmoothGrain, InpaintBorders, CloseHoles, FillOpenTexels, PlaceOnPage
//   plan/      PlanMemory        charts, photographs   -> how much at once; where to stand for more
//   tiles1988/ MakeTiles         photographs           -> Thorman's tiles, for comparison
//
// BakeTextures calls them. The thresholds and weights of each are in a struct of BakeOptions, and
// BakeStages holds those that can be exchanged for others.
namespace groundglass {

struct BakeResult {
  TexturedModel model;
  Coverage coverage;
  std::vector<int> new_faces;  // of the model, that as_photographed has no part of; ascending
  double texel_scale = 1;  // above 1: texels were made this much longer to stay within the memory
  std::vector<std::string> remarks;  // for a person: where texels are not as one would expect
};

// Inverse rendering (Thorman 1988, chapter 4): every texel of every face is looked up through the
// exact camera in the photographs that see it. Texels that no photograph shows are grey, with
// provenance 0; a face that none shows has no texture. Throws Error for an image that cannot be
// read or does not fit its camera.
BakeResult BakeTextures(const PolygonModel& model,
                        std::span<const BakePhotograph> photographs,
                        const BakeOptions& options = {},
                        const Progress& progress = {});

}  // namespace groundglass
