// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/colour/colour.h"
#include "invrender/compose/fill.h"
#include "invrender/compose/grain.h"
#include "invrender/inputs/bake_photograph.h"
#include "invrender/inputs/blend_options.h"
#include "invrender/inputs/block_options.h"
#include "invrender/inputs/chart_options.h"
#include "invrender/inputs/coverage_options.h"
#include "invrender/inputs/memory_options.h"
#include "invrender/inputs/page_options.h"
#include "invrender/inputs/photo_options.h"
#include "invrender/measure/sharpness.h"
#include "invrender/select/choose.h"
#include "invrender/select/seams.h"
#include "scene/polygon_model.h"

#include <functional>
#include <optional>
#include <vector>

namespace groundglass {

// The stages of texturing that can be exchanged. Another function in a stage's place is another
// method, or none (tests/bench/invrender_ablation_bench.cc).
struct BakeStages {
  // Gains, vignetting and light, from every chart's blocks.
  std::function<ColourModel(
      const std::vector<ChartBlocks>&, size_t num_photos, const ColourOptions&)>
      estimate_colour = EstimateColour;
  // One for each photograph; empty: all are alike.
  std::function<std::vector<Sharpness>(
      const std::vector<Patch>&, size_t num_photos, const SharpnessOptions&)>
      measure_sharpness = MeasureSharpness;
  // ChartChoice::consistency of one chart.
  std::function<std::vector<float>(
      const ChartBlocks&, int chart, const ColourModel&, const ConsistencyOptions&)>
      measure_consistency = MeasureConsistency;
  std::function<ChartChoice(const ChartBlocks&, std::vector<float> consistency)> choose_blocks =
      ChooseBlocks;
  std::function<void(
      const ChartBlocks&, int chart, const ColourModel&, const SeamOptions&, ChartChoice&)>
      smooth_seams = SmoothSeams;
  std::function<void(const GrainInputs&, const GrainOptions&, ChartPixels&)> smooth_grain =
      SmoothGrain;
  // Called if BakeOptions::fill_gaps.
  std::function<void(const FillOptions&, ChartPixels&)> fill_gaps = FillOpenTexels;

  // Throws Error naming the first that is empty, behind `path`.
  void Check(const std::string& path = "bake stages: ") const;
};

// The options of all stages, in the order in which they work.
struct BakeOptions {
  ChartOptions charts;
  PhotoOptions photos;
  PageOptions pages;
  MemoryOptions memory;
  BlockOptions blocks;
  PatchOptions patches;
  SharpnessOptions sharpness;
  GrainOptions grain;
  ColourOptions colour;
  ConsistencyOptions consistency;
  SeamOptions seams;
  BlendOptions blend;
  DilateOptions dilate;
  FillOptions fill;
  CoverageOptions coverage;
  BakeStages stages;

  // Fits a gain for each photograph and channel, its vignetting, and how the light fell on each
  // face. Turn off to see the photographs' own exposures.
  bool match_colour = true;
  // Keeps out what differs from what most photographs show: trees, cars, cast shadows.
  bool reject_occluders = true;
  // Paints over what no photograph shows, from what lies around it; provenance says so.
  bool fill_gaps = false;

  // The model as it was when the photographs were taken, where it has changed since, in the same
  // frame and unit. Photographs then texture what both have; what is new stays plain.
  std::optional<PolygonModel> as_photographed;
  EarlierModelOptions earlier_model;

  // Gets each photograph's automatic face mask (MakeFaceMask) with the faces' numbers, from several
  // threads at once.
  FaceMaskObserver on_face_mask;

  void Check() const;  // throws Error naming the first field out of range
};

}  // namespace groundglass
