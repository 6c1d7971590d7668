// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "drawing/drawing.h"
#include "drawing/write_drawing.h"
#include "scene/formats/textured_model_io.h"
#include "scene/textured_model.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// What `render` takes to draw to scale rather than from a view.
struct ElevationArguments {
  std::string elevation;  // faces, a direction, or "all"
  std::string section;    // "x,y,x,y" or "z=1.2"
  std::vector<std::string> developed;
  DrawingOptions drawing;
  double margin_mm = 5;  // on paper
  std::vector<std::string> also;
  WriteDrawingOptions write;

  bool IsAsked() const { return !elevation.empty() || !section.empty() || !developed.empty(); }
};
void AddElevationOptions(CLI::App* command, ElevationArguments& arguments);

// Writes the drawings of a model beside one another. folder: the output folder that the model is
// from, which tells of photographs; empty if it is from elsewhere. out: the first file.
int RenderElevations(const ElevationArguments& arguments,
                     const CommonOptions& common,
                     const TexturedModel& textured,
                     const std::filesystem::path& folder,
                     const std::filesystem::path& out,
                     const std::vector<std::string>& warnings);

}  // namespace groundglass
