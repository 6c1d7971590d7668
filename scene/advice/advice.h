// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/scene_folder.h"

#include <string>
#include <vector>

namespace groundglass {

// Something about a scene that can be read but cannot well be meant, and what to do about it.
struct Advice {
  // kScene: what is odd concerns every photograph, so that nothing will fit before it is mended.
  enum class Severity { kScene, kDetail };
  Severity severity = Severity::kDetail;
  std::string subject;  // the file that it is about
  std::string message;  // what is odd, in numbers
  std::string remedy;   // what to do, an option or a command where there is one
};

// "SUBJECT: MESSAGE; REMEDY", one line.
std::string FormatAdvice(const Advice& advice);
// A length in the model's unit and in metres: "12.3 ft (3.75 m)".
std::string FormatLength(double length, LengthUnit unit);

// What is odd about a scene (docs/check.md): its model's size, axes and coordinates, where its
// cameras stand, its pictures. Silent about what is merely unusual: each is told only if the scene
// as it was read is implausible, and another reading of it (if one is named) plausible.
// `options`: as the model was read. Pictures are decoded if `with_pictures`.
std::vector<Advice> FindOddities(const Scene& scene,
                                 const ModelOptions& options = {},
                                 bool with_pictures = true);

}  // namespace groundglass
