// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/view_tag.h"

#include <array>
#include <string>
#include <vector>

namespace groundglass {

// What people write down wrongly in one tag, and how to say it.
struct TagSlip {
  const char* name;  // "x and y exchanged"
  void (*correct)(ViewTag& tag);
};
// The likelier ones first.
extern const std::array<TagSlip, 28> kTagSlips;

// A tag as it was meant, if this slip was made.
struct MeantTag {
  std::string slip;  // "x and y exchanged", "x 46.7 (two digits exchanged)": "with ... it would"
  ViewTag tag;
  bool is_of_digits = false;  // one of many ways to change digits, which suit a tag by chance too
  std::array<bool, kNumTagKeys> is_changed{};  // of its numbers, those that the slip has changed
};
// What the tag may have been meant to be (its numbers that people write, not those that were
// computed), valid ones only, the likelier ones first: with one of
// kTagSlips, or with two neighbouring digits exchanged in one number, or one too many.
std::vector<MeantTag> FindMeantTags(const ViewTag& tag);
// With a digit that was left out of one number, or another in its place: there are some hundred.
std::vector<MeantTag> FindMeantTagsByDigits(const ViewTag& tag);

}  // namespace groundglass
