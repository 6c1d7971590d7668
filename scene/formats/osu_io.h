// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A model as read, with what was odd but not wrong ("face 12 (east wall) is 0.4 % out of plane").
struct ModelReading {
  PolygonModel model;
  std::vector<std::string> warnings;
  std::vector<int> left_out = {};  // the numbers of its file's faces that it does not have
};

// Extended OSU (docs/osu-model.md): `site` in the file, `world` in memory.
// Throws Error naming file, line and face.
ModelReading ReadOsu(const std::filesystem::path& file);
ModelReading ParseOsu(const std::string& text, const std::filesystem::path& name);
// Every fault that ParseOsu could throw, one line each; empty if the text is valid.
std::vector<std::string> FindOsuFaults(const std::string& text, const std::filesystem::path& name);
// Shortest digits that read back exactly; names and unit as comments.
std::string FormatOsu(const PolygonModel& model);

}  // namespace groundglass
