// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/view_tag.h"

#include <array>

namespace groundglass {

// What people write down wrongly in one tag, and how to say it.
struct TagSlip {
  const char* name;  // "x and y exchanged"
  void (*correct)(ViewTag& tag);
};
// The likelier ones first.
extern const std::array<TagSlip, 25> kTagSlips;

}  // namespace groundglass
