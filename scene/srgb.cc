// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/srgb.h"

#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// Both directions are tabulated at 2^16 steps and interpolated: within 1e-7 of the formula, and
// fast enough for every texel.
constexpr int kTableSteps = 65536;

double ExactLinearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double ExactSrgbFromLinear(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::vector<float> MakeTable(double (*function)(double)) {
  std::vector<float> table(kTableSteps + 1);
  for (int i = 0; i <= kTableSteps; ++i) {
    table[i] = static_cast<float>(function(static_cast<double>(i) / kTableSteps));
  }
  return table;
}

float Interpolate(const std::vector<float>& table, float value) {
  const float position = value * kTableSteps;
  const int step = static_cast<int>(position);
  if (step >= kTableSteps) return table[kTableSteps];
  const float fraction = position - static_cast<float>(step);
  return table[step] + fraction * (table[step + 1] - table[step]);
}

}  // namespace

float LinearFromSrgb(float encoded) {
  static const std::vector<float> table = MakeTable(ExactLinearFromSrgb);
  if (!(encoded > 0)) return 0;
  if (encoded >= 1) return 1;
  return Interpolate(table, encoded);
}

float SrgbFromLinear(float linear) {
  static const std::vector<float> table = MakeTable(ExactSrgbFromLinear);
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return Interpolate(table, linear);
}

const std::array<float, 256>& LinearOfSrgb8() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> linear;
    for (size_t code = 0; code < linear.size(); ++code) {
      linear[code] = LinearFromSrgb(static_cast<float>(code) / 255.0f);
    }
    return linear;
  }();
  return table;
}

uint8_t Srgb8FromLinear(float linear) {
  return static_cast<uint8_t>(std::lround(255 * SrgbFromLinear(linear)));
}

}  // namespace groundglass
