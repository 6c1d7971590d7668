// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <array>
#include <vector>

namespace groundglass {

struct PhotoGrainOptions {
  // A photograph is looked at in squares of this many pixels; the grain of one is what a blur of
  // blur_px takes away.
  int square_px = 24;
  double blur_px = 2.5;
  // Of the squares of each tone this share shows the least, and is taken to show nothing but grain.
  double calm_share = 0.05;
  // Grain differs by less than this between tones: where even the calmest squares of a tone show
  // more than so many times the least tone's, it is not grain that they show.
  double most_between_tones = 2;
  // Squares whose mean code lies below or above are left out: there film and scanner clip.
  int darkest_code = 12;
  int brightest_code = 243;
  // As many squares as this are kept of each tone, to lay from.
  int most_squares = 24;

  void Check() const;  // throws Error naming the first field out of range
};

// The grain of one photograph: how strong it is in each tone, and squares of it.
struct PhotoGrain {
  static constexpr int kTones = 4;  // of the mean code, evenly from 0 to 255
  // One standard deviation of luma, codes of 0 to 255; a tone of which the photograph
  // shows no calm square has its neighbour's. All 0 where there is no calm square at all.
  std::array<double, kTones> sigma = {};
  // What the blur takes away from calm squares, each over its own deviation of luma; 3 channels.
  std::vector<ImageF> squares;

  // Between tones linearly.
  double SigmaAt(double code) const;
};

PhotoGrain MeasurePhotoGrain(const Image8& srgb8, const PhotoGrainOptions& options);

// Grain of unit deviation and of the same look as the squares, 3 channels: squares that chance
// chooses, laid over one another by half (Efros and Freeman, SIGGRAPH 2001, have seams; grain needs
// none), weighted so that the deviation stays. The same seed gives the same grain.
ImageF LayGrain(const PhotoGrain& grain, int width, int height, uint64_t seed);

}  // namespace groundglass
