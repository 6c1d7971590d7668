// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "viewer/montage_light.h"

#include <algorithm>
#include <cstdint>
#include <random>

namespace groundglass {

inline MontageLight LowSun() {
  MontageLight light;
  light.gain = {0.8, 0.7, 0.6};
  light.average = 0.9;
  light.direction_in_world = {0.25, -0.3, 0.2};
  return light;
}

// An even picture with structure in its lower half, and grain of this deviation.
inline Image8 GrainyPicture(double sigma, uint64_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> grain(0, sigma);
  Image8 picture(360, 240, 3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double structure = y > 140 && (x / 5 + y / 7) % 2 == 0 ? 40 : 0;
      const double shared = grain(random);
      for (int c = 0; c < 3; ++c) {
        picture.At(x, y)[c] =
            static_cast<uint8_t>(std::clamp(120 + structure + shared, 0.0, 255.0) + 0.5);
      }
    }
  }
  return picture;
}

}  // namespace groundglass
