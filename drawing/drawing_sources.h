// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A photograph that textures a face. Lengths on the face, in the model's unit.
struct DrawnSource {
  int photograph = 0;    // in DrawingSources::photographs
  double texels = 0;     // how much of the face it gives
  double footprint = 0;  // its pixel
  // One standard deviation of where its camera puts what it shows; nothing if nobody says.
  std::optional<double> camera_sigma;
  // How far something that stands out of the face by 1 is drawn beside its place: the tangent of
  // the angle from which the photograph looks.
  std::optional<double> slant;
};

// What an output folder says of where a drawing's colours come from.
struct DrawingSources {
  std::vector<std::string> photographs;         // in the order of provenance numbers, from 1
  std::vector<Image16> provenance;              // of each texture page; empty if there are none
  std::vector<std::vector<DrawnSource>> faces;  // of each of the model's

  const DrawnSource* Find(int face, int photograph) const;
};

// Reads coverage.json, registration.json, faces/ and provenance_N.png. What is not there is left
// empty; Error for provenance that does not fit the model's pages and, if it is needed, for one
// that is not there.
DrawingSources ReadDrawingSources(const std::filesystem::path& folder,
                                  const TexturedModel& textured,
                                  bool needs_provenance);

}  // namespace groundglass
