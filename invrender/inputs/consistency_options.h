// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// The histogram of the colours that a chart is known to have (ColourHistogram).
struct HistogramOptions {
  // Bins to a log unit of radiance, each way. Finer bins tell more colours apart and need more
  // blocks to be filled.
  float bins_per_unit = 4;
  // With fewer counts than this nothing is known of the chart, and every colour is ordinary.
  double fewest_counts = 100;
  // Colours that make up this share of the chart, with the bins around theirs, are ordinary.
  double ordinary_share = 0.05;
  // Added to every share (additive smoothing): how common a colour is that was never seen.
  double unseen_share = 1e-4;
  // The largest negative log-likelihood, natural logarithm of how much rarer than ordinary a colour
  // is.
  float max_negative_log_likelihood = 6;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "histogram options: ") const;
};

// Who shows what stands there, and who shows something else (MeasureConsistency). Inconsistency is
// a squared difference of corrected colour in units of ordinary_difference.
struct ConsistencyOptions {
  // Difference of corrected colour (log units, root of the mean square over channels) that is
  // ordinary: film grain, resolution, a pixel of misregistration. Raise it where cameras are
  // poorly known or the light changed much; lower it to tell fainter occluders.
  float ordinary_difference = 0.22f;
  // Inconsistency beyond this is all alike, so that one glaring view does not outweigh several.
  float max_inconsistency = 9;
  // Views with less inconsistency than this agree.
  float agreeing = 1;
  // Weight of the negative log-likelihood of a view's colour under the chart's histogram; 0: none.
  // It decides where two photographs stand against one another.
  float histogram_weight = 0.5f;
  // How much a view of lower quality loses, for each e-fold, when the consensus is sought.
  float blur_weight = 1;
  // A view's vote is its quality over this (log units) plus the unevenness of its photograph's
  // light. Smaller values give photographs in even light more of the say.
  double vote_unevenness = 0.1;
  // Sun and cast shadows: how fast, for each log unit of unevenness, photographs lose.
  double even_light_preference = 2;

  // Blocks to each side that cost, inconsistency and consensus are averaged over. An occluder is
  // larger than a block; larger radii calm decisions and round the occluders' outlines.
  int cost_radius = 2;
  int inconsistency_radius = 1;
  int consensus_radius = 2;

  // Where less than this share of the votes agrees, there is no majority, and a whole region of
  // such blocks is judged at once.
  float majority = 0.34f;
  // So many views are needed for one in the middle to say something, and for a blurred one to be
  // left out: of two, one may show an occluder, and a blurred wall is better than a sharp van.
  int fewest_to_compare = 3;
  // Without a majority among so many, inconsistency counts only this much, and the photograph that
  // shows the place best is a good guess.
  float disputed_weight = 0.25f;

  HistogramOptions histogram;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "consistency options: ") const;
};

}  // namespace groundglass
