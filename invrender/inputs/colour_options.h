// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <array>
#include <string>

namespace groundglass {

// How the photographs' colours are brought together (EstimateColour). Log units are natural.
struct ColourOptions {
  // What counts as no difference of light from face to face, log units. Larger values give sunny
  // photographs more of a say beside those in even light.
  double even_light = 0.06;

  // Pairs of photographs that share fewer blocks of a chart than this say nothing there.
  int fewest_shared = 6;
  // Of a chart about so many blocks are looked at for pairs, and of a pair at most so many kept.
  // Raise them for accuracy, lower them for time.
  int enough_for_pairs = 20000;
  int enough_of_pair = 600;
  // Hundreds of photographs of the same walls have more pairs than memory holds, and than settle
  // the gains: beyond so many blocks of pairs only every so manieth pair is taken.
  int most_shared = 12000000;

  // Vignetting: what grain and small occluders do, log units; how often outliers are weighed anew;
  // and for how much each photograph's is pulled to the mean of all (in squared units of radius
  // that its blocks spread over).
  double vignetting_scale = 0.15;
  int vignetting_rounds = 4;
  double vignetting_prior = 20;

  // Gains: a chart with so many blocks has half of the weight that one with very many has.
  double many_blocks = 50;
  // Differences beyond these, log units, are doubted, one round after another: from sun on whole
  // walls down to what exposures are off by.
  std::array<double, 11> gain_scales = {2.0, 1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.13, 0.1, 0.1, 0.1};
  // A weak pull to none, which anchors the mean, and photographs that share nothing.
  double gain_prior = 1e-3;

  // The light on each face: rounds; below about so many blocks a chart's gain is pulled to none;
  // medians need no more blocks than so many.
  int light_rounds = 3;
  double few_blocks = 12;
  int enough_for_light = 3000;
  // Gains of faces beyond this, log units, count as this when a photograph's unevenness is judged.
  double most_uneven = 1;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "colour options: ") const;
};

}  // namespace groundglass
