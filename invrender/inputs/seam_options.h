// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// What seams between photographs cost (SmoothSeams). Costs are natural logarithms of quality: 0.7
// is half the resolution.
struct SeamOptions {
  // The most that a photograph can lose by being worse than a block's best.
  double worst = 12;
  // One block's side of seam where nothing shows. Raise it for fewer and larger pieces.
  double side = 0.15;
  // More for each log unit that the two photographs differ there. Raise it to move seams farther
  // to where they do not show, at the expense of resolution.
  double per_difference = 4;
  // Differences beyond this (log units) are all alike.
  double most_different = 1;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "seam options: ") const;
};

}  // namespace groundglass
