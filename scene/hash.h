// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cstdint>

namespace groundglass {

// A well mixed 64-bit hash (the finaliser of SplitMix64; Steele, Lea and Flood 2014): chance that
// depends on a seed and a place alone, whatever the order in which places are asked for.
inline uint64_t HashOf(uint64_t value) {
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

}  // namespace groundglass
