// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

double Quintic(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

double LatticeValue(uint64_t seed, int64_t x, int64_t y) {
  const uint64_t hash = HashOf(seed, static_cast<uint64_t>(x), static_cast<uint64_t>(y));
  return 2 * UniformOf(hash) - 1;
}

// The integral from 0 to x of the line pattern, its lines starting at the multiples of `period`.
double LinesIntegral(double x, double period, double line) {
  const double whole = std::floor(x / period);
  return whole * line + std::min(x - whole * period, line);
}

}  // namespace

uint64_t HashOf(uint64_t seed, uint64_t a, uint64_t b, uint64_t c) {
  return HashOf(seed ^ (a * 0x9e3779b97f4a7c15u + HashOf(b * 0xd6e8feb86659fd93u + c)));
}

uint64_t SeedFor(uint64_t seed, std::string_view purpose, uint64_t index) {
  uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char letter : purpose) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
  }
  return HashOf(seed, hash, index);
}

double UniformOf(uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1.0p-53; }

double NormalOf(uint64_t hash) {
  const double radius = std::sqrt(-2 * std::log(1 - UniformOf(hash)));
  return radius * std::cos(2 * std::numbers::pi * UniformOf(HashOf(hash)));
}

double ValueNoise(uint64_t seed, double x, double y) {
  const double floor_x = std::floor(x);
  const double floor_y = std::floor(y);
  const auto column = static_cast<int64_t>(floor_x);
  const auto row = static_cast<int64_t>(floor_y);
  const double tx = Quintic(x - floor_x);
  const double ty = Quintic(y - floor_y);
  const double top =
      std::lerp(LatticeValue(seed, column, row), LatticeValue(seed, column + 1, row), tx);
  const double bottom =
      std::lerp(LatticeValue(seed, column, row + 1), LatticeValue(seed, column + 1, row + 1), tx);
  return std::lerp(top, bottom, ty);
}

double FilteredNoise(uint64_t seed,
                     double x,
                     double y,
                     double frequency,
                     int octaves,
                     double width_x,
                     double width_y) {
  double sum = 0;
  double strength = 0.6;
  const double width = std::max(width_x, width_y);
  for (int octave = 0; octave < octaves; ++octave) {
    // Full while a period spans four footprints, gone when it spans two.
    const double fade = std::clamp(2 - 4 * frequency * width, 0.0, 1.0);
    if (fade <= 0) break;
    sum += fade * strength * ValueNoise(seed + octave, x * frequency, y * frequency);
    frequency *= 2;
    strength /= 2;
  }
  return sum;
}

double FilteredLines(double x, double width, double period, double line) {
  const double shifted = x + line / 2;
  if (width < 1e-9) return shifted - period * std::floor(shifted / period) < line ? 1 : 0;
  return (LinesIntegral(shifted + width / 2, period, line) -
          LinesIntegral(shifted - width / 2, period, line)) /
         width;
}

double FilteredInterval(double x, double width, double low, double high) {
  if (width < 1e-9) return x >= low && x < high ? 1 : 0;
  return std::max(0.0, std::min(x + width / 2, high) - std::max(x - width / 2, low)) / width;
}

}  // namespace groundglass
