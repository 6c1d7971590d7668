// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "ask/survey_map.h"
#include "scene/textured_model.h"
#include "viewer/line_drawing.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What the model's faces may be coloured by.
// kTiles1988: drawn by the tiles of the database of 1988, which is no matter of ColourModel.
enum class LookMap { kNone, kCoverage, kProvenance, kTexelSize, kUncertainty, kTiles1988 };

// What a colour means.
struct LegendEntry {
  Srgb8Colour colour;
  std::string label;
};

// The legend of a map: colours one by one, or a scale without steps, from the first to the last.
struct Legend {
  std::string title;  // with the unit
  bool is_continuous = false;
  // Of a scale without steps its colours at even places, and behind them that of no value.
  std::vector<LegendEntry> entries;
};

// The model with a map's colours for its texture.
struct ColouredModel {
  TexturedModel textured;
  Legend legend;
};

// All that a map may be made of. What there is none of is empty.
struct MapSources {
  const TexturedModel* textured = nullptr;
  const Survey* survey = nullptr;
  const std::vector<FaceCells>* cells = nullptr;
  const TexelSources* texels = nullptr;
};

// kProvenance and kTexelSize are those of the texture where there is one; else which photograph
// shows a place finest, and how large its pixel is there. Scales are the same for all scenes.
std::shared_ptr<const ColouredModel> ColourModel(LookMap map, const MapSources& sources);

// A photograph's colour by its place among them: seven of Okabe and Ito's, then lighter and darker
// ones of the same, and from the 22nd on again.
Srgb8Colour PhotographColour(int photograph);

// The colour of a length on the maps' scale, from a millimetre to a metre, each power of ten as
// long as another: dark is good, and each step lighter than the one before.
Srgb8Colour LengthColour(double length_m);
// The same by the place on the scale, from 0 to 1.
Srgb8Colour LengthScaleColour(double share);

}  // namespace groundglass
