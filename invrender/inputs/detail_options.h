// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// Where photographs are compared for blur and grain (SamplePatches).
struct PatchOptions {
  // No more patches than this, and of each the best views only. Raise both for accuracy, lower them
  // for time.
  int max_patches = 3000;
  int max_views = 6;
  // Pixels longer than this many of the best photograph's say little of fine detail.
  double max_coarseness = 2;
  // Patches lie farther than this from borders, px.
  double clear_px = 3;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "patch options: ") const;
};

// How blurred photographs are told (MeasureSharpness).
struct SharpnessOptions {
  // Correlation from which two photographs show the same, so that a patch compares them.
  double alike = 0.7;
  // Variance of the blur of a good slide, px^2 (wiesner's recipe: a lens of 0.6 px, and pixels),
  // and for how many patches that counts. Photographs that share little with others keep it.
  double ordinary_blur_px2 = 0.45;
  double ordinary_weight = 1;
  // No photograph is sharper: pixels themselves, and a very good lens.
  double least_blur_px2 = 0.25;
  // From so many times the ordinary variance a photograph begins to count as blurred, and from so
  // many it wholly does: brick, where none is, has up to 2.2 by error; slides of wiesner and hard
  // that are have 2.5 to 4.
  double doubtful = 2.3;
  double certain = 3;
  // What grain leaves in a second derivative of brightness, relative to the mean, is less than
  // this: patches with much less detail say nothing. Raise it for coarser film.
  double detail_floor = 0.02;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "sharpness options: ") const;
};

// How film grain is told from detail (MeasureGrain) and lowered (SmoothGrain).
struct GrainOptions {
  // Agreement (correlation) of pure grain over a few patches, and where shared detail is beyond
  // doubt: the charts of wiesner, with grain, have 0.07 to 0.19 (but two that are full of joints),
  // those of brick 0.26 to 0.49, whether cameras are exact or corrected. Raise both to smooth more.
  double grain_agreement = 0.18;
  double detail_agreement = 0.26;
  // One in so many of a chart's patches, the calmest, is asked for agreement.
  int calm_one_in = 3;
  // For so many patches the mean of all charts counts in each.
  double few_patches = 20;

  // Pairs of photographs with fewer patches than this say nothing of their grain.
  int fewest_patches = 6;
  // The quantile of a pair's differences that counts: the calmer ones, where nothing else differs.
  double calm_quantile = 0.3;
  // For so many patches a photograph counts as like the others.
  double prior_patches = 20;
  // Patches darker than this (encoded, 1 is white) do not compare.
  float dark = 0.1f;

  // Where the frame's vignetting is taken for a whole chart, squared distance from the middle, 1 at
  // the corners.
  double vignetting_at = 0.3;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "grain options: ") const;
};

}  // namespace groundglass
