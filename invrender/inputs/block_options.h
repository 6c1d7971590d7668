// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// Which views of a block say something of its colour (ObserveBlocks).
struct BlockOptions {
  // Radiance, 1 is white: what is darker in some channel, or brighter, is black or burnt out. Raise
  // `black` for film with deep shadows, lower `burnt` for film whose highlights bend early.
  float black = 0.002f;
  float burnt = 0.93f;
  // A block's middle must be farther than this from borders, px.
  double clear_px = 2;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "block options: ") const;
};

}  // namespace groundglass
