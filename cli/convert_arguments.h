// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "cli/model_arguments.h"
#include "scene/formats/convert.h"
#include "scene/length_unit.h"
#include "scene/text.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace groundglass {

struct ConvertArguments {
  CommonOptions common;
  std::string input;
  std::string output;
  ModelArguments model_arguments;
  std::optional<LengthUnit> output_unit;
  std::string images;
  std::string format;  // that cameras are written in; empty: view files, or COLMAP's text
  double lookat_distance = 100;
};

// Whether a file's name ends so, in capitals too; ending: in small letters.
inline bool EndsIn(const std::string& file, std::string_view ending) {
  return LowerCase(file).ends_with(ending);
}

// What `exchange` does of it. `--to`, with the programs that it knows:
void AddCameraFormatOption(CLI::App* command, std::string& format);
// Cameras of other programs' and of output folders, and models of cities; nothing if the input and
// what is to become of it are neither.
std::optional<ConvertResult> ConvertExchanged(const ConvertArguments& arguments);

}  // namespace groundglass
