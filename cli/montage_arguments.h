// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "scene/formats/model_io.h"
#include "viewer/montage.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace groundglass {

// What `render` takes to draw a design into a photograph.
struct MontageArguments {
  std::string photograph;  // its name, or its file
  std::filesystem::path design;
  std::filesystem::path scene;  // of an output folder
  bool no_grain = false;
  MontageOptions montage;

  bool IsAsked() const { return !photograph.empty(); }
};
void AddMontageOptions(CLI::App* command, MontageArguments& arguments);

// Writes the montage. folder: an output folder, or a scene whose tags are believed; model_options:
// how the design is read.
int RenderMontage(const MontageArguments& arguments,
                  const CommonOptions& common,
                  const std::filesystem::path& folder,
                  const ModelOptions& model_options,
                  const std::filesystem::path& out);

}  // namespace groundglass
