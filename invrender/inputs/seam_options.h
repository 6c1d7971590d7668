// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// The energy that SmoothSeams minimises over the blocks of a chart. A block's data cost is the
// natural logarithm of its best photograph's quality over that of the one taken (0.7: half the
// resolution); seams between blocks that take different photographs cost more.
struct SeamOptions {
  // The most that a block's data cost can be.
  double max_data_cost = 12;
  // Cost of one block's side of seam where the photographs look alike. Raise it for fewer and
  // larger pieces.
  double seam_cost = 0.15;
  // More for each log unit that the two photographs differ there. Raise it to move seams farther
  // to where they do not show, at the expense of resolution.
  double difference_cost = 4;
  // Differences beyond this (log units) are all alike.
  double max_difference = 1;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "seam options: ") const;
};

}  // namespace groundglass
