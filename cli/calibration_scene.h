// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/slide_frame.h"
#include "cli/commands.h"
#include "cli/model_arguments.h"
#include "scene/formats/known_keys.h"
#include "scene/polygon_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What the parts of `calibrate` that look at a scene's own photographs take.
struct CalibrationArguments {
  CommonOptions common;
  std::vector<std::filesystem::path> inputs;  // a scene folder, or photographs
  std::filesystem::path out_folder;           // empty: calibration/ of the scene folder
  std::optional<std::filesystem::path> model_file;
  ModelArguments model_arguments;
};
void AddCalibrationArguments(CLI::App* command, CalibrationArguments& arguments);

struct CalibrationPhotograph {
  std::string name;
  std::filesystem::path file;
};

struct CalibrationScene {
  std::vector<CalibrationPhotograph> photographs;
  std::optional<PolygonModel> model;   // the given one, or the scene folder's
  std::filesystem::path scene_folder;  // empty if photographs are given
  std::filesystem::path out_folder;    // empty if nothing is to be written
};

// Reads what the arguments name, pictures aside: of a scene folder, those in this folder of it.
// Throws Error if that is nothing.
CalibrationScene ReadCalibrationScene(const CalibrationArguments& arguments,
                                      const std::string& subfolder = "images");

// What a picture of a television frame's size holds, unless its metadata tell the digital camera
// that took it.
std::optional<VideoAspect> VideoAspectOf(const std::filesystem::path& file,
                                         const FrameOptions& options = {});

// What one source (the subcommand's name) found, into calibration/NAME.view beside what others
// found (MergeKnownKeys). Nothing if nothing is to be written.
void WriteKnownKeys(const CalibrationScene& scene,
                    const std::string& photograph,
                    const KnownKeys& keys,
                    const std::string& source);

// "v 65.5 +- 1.3, roll 0.2": numbers for a person, rounded.
std::string DescribeKnownKeys(const KnownKeys& keys);

}  // namespace groundglass
