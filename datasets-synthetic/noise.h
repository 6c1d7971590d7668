// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/hash.h"

#include <cstdint>
#include <string_view>

namespace groundglass {

// Counter-based randomness: the value at a place depends on the seed and the place alone, so that
// pictures come out the same whatever the order, and the number of threads, they are made in.

// Of a seed and a place (HashOf in scene/hash.h).
uint64_t HashOf(uint64_t seed, uint64_t a, uint64_t b = 0, uint64_t c = 0);
// A seed of its own for each purpose ("grain", "slide") and each thing.
uint64_t SeedFor(uint64_t seed, std::string_view purpose, uint64_t index = 0);

// Uniform in [0, 1).
double UniformOf(uint64_t hash);
// Standard normal, by Box and Muller's transformation of two uniforms drawn from the hash.
double NormalOf(uint64_t hash);

// Value noise on the unit lattice, in [-1, 1], with quintic interpolation.
double ValueNoise(uint64_t seed, double x, double y);

// Sum of `octaves` octaves of value noise from `frequency` (cycles for each unit of x and y),
// halving in strength; each octave fades out before its period falls below two footprints
// (`width_x`, `width_y`, units of x and y), so the sum never aliases. About [-1, 1].
double FilteredNoise(uint64_t seed,
                     double x,
                     double y,
                     double frequency,
                     int octaves,
                     double width_x,
                     double width_y);

// The mean, over [x - width / 2, x + width / 2], of lines of `line` width centred at the multiples
// of `period`: 1 on the line, 0 off it. Exact, so lines far thinner than a pixel stay grey.
double FilteredLines(double x, double width, double period, double line);
// The same for the interval [low, high].
double FilteredInterval(double x, double width, double low, double high);

}  // namespace groundglass
