// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "drawing/drawing.h"
#include "drawing/drawing_sources.h"
#include "viewer/renderer.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A number over a drawing's pixels: half of them are below `middle`, a tenth below `low`, a tenth
// above `high`.
struct Spread {
  double low = 0;
  double middle = 0;
  double high = 0;
};

// What a drawing at a scale promises, and what the photographs and the model give. Metres on the
// building; shares of the pixels that show the model.
struct DrawingAccuracy {
  double scale = 50;
  double pixel_m = 0;    // of the output
  double promise_m = 0;  // a quarter of a millimetre on paper
  std::optional<Spread> photograph_pixel_m;
  std::optional<Spread> camera_sigma_m;
  double model_sigma_m = 0;
  bool is_model_sigma_assumed = false;  // neither the file nor an option says it
  double off_plane_share = 0;           // farther from the plane than the promise
  double most_before_m = 0;
  double most_behind_m = 0;
  // How far beside its place something 1 m off the model's faces is drawn.
  std::optional<Spread> slant;
  // Of what is shown, what no photograph does: by the texels, if the sources have provenance, else
  // by faces that none textures.
  double untextured_share = 0;
};

DrawingAccuracy AssessDrawing(Renderer& renderer,
                              const TexturedModel& textured,
                              const Drawing& drawing,
                              const DrawingSources& sources,
                              double scale,
                              double pixel_size);

// For a person, one sentence each: pixels and sigmas, what lies off the plane, what the model
// lacks.
std::vector<std::string> DescribeAccuracy(const DrawingAccuracy& accuracy);
// Where the scale promises more than there is, for which of model, cameras and pixels, and what
// would mend it; empty if all is well. A model that does not say how sure it is gives a sentence
// above, and no warning.
std::vector<std::string> AccuracyWarnings(const DrawingAccuracy& accuracy);

// "5 mm", "12.5 mm", "0.35 m".
std::string FormatLength(double metres);

}  // namespace groundglass
