// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/model_io.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace groundglass {

// What every command that reads a model takes, to read it otherwise than its file says.
struct ModelArguments {
  std::optional<LengthUnit> unit;
  std::string frame;  // "world", "site"; empty: the format's own
  std::string up;     // "y", "z"; empty: the format's own
  std::optional<double> sigma;
  bool flip_faces = false;

  // Error where the options contradict each other.
  ModelOptions Options() const;
};
void AddModelOptions(CLI::App* command, ModelArguments& arguments);

// In one line, which model of the folder is read where several lie in it, and how to choose
// another; nothing if there is only one.
std::optional<std::string> DescribeOtherModels(const std::filesystem::path& folder,
                                               const std::filesystem::path& model_file);

// "How far its edges may lie off" in words: "0.1 ft (0.03 m), as the model says".
std::string DescribeTolerance(const PolygonModel& model, const ModelArguments& arguments);

}  // namespace groundglass
