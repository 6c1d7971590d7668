// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_lines.h"
#include "cli/calibrate_parts.h"
#include "cli/calibration_scene.h"
#include "cli/json_output.h"
#include "cli/option_range.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace groundglass {
namespace {

struct LinesArguments {
  CalibrationArguments calibration;
  LinesOptions options;
};

// Width / height as the photograph's tag, or calibration/, has it, or as a television frame may
// have it; pixels are square where none of these says otherwise.
void FindAspect(const CalibrationScene& scene,
                const CalibrationPhotograph& photograph,
                LinesOptions& options) {
  for (const char* folder : {"views", "calibration"}) {
    const std::filesystem::path file = scene.scene_folder / folder / (photograph.name + ".view");
    if (scene.scene_folder.empty() || !std::filesystem::is_regular_file(file)) continue;
    options.aspect_sigma = 0;
    for (const KnownKey& key : ReadKnownKeys(file)) {
      if (key.key == "a") options.aspect = ParseNumber(key.value);
      if (key.key == "sigma_a") options.aspect_sigma = ParseNumber(key.value).value_or(0);
    }
    if (options.aspect) return;
  }
  if (const std::optional<VideoAspect> video = VideoAspectOf(photograph.file)) {
    options.aspect = video->aspect;
    options.aspect_sigma = video->sigma;
  }
}

nlohmann::ordered_json JsonFromLines(const std::string& name, const LinesResult& result) {
  if (!result.is_found) return {{"name", name}, {"found", false}, {"reason", result.reason}};
  return {{"name", name},
          {"found", true},
          {"v", result.view_angle_deg},
          {"sigma_v", result.sigma_view_angle_deg},
          {"roll", result.roll_deg},
          {"sigma_roll", result.sigma_roll_deg},
          {"shift_x", result.shift_x},
          {"sigma_shift_x", result.sigma_shift_x},
          {"shift_y", result.shift_y},
          {"sigma_shift_y", result.sigma_shift_y},
          {"k1", result.k1},
          {"sigma_k1", result.sigma_k1},
          {"pitch", result.pitch_deg},
          {"sigma_pitch", result.sigma_pitch_deg},
          {"lines", result.num_of_direction},
          {"rms_px", result.rms_px}};
}

void PrintLines(const std::string& name, const LinesResult& result, const KnownKeys& keys) {
  if (!result.is_found) {
    std::printf("%s: nothing, since %s\n", name.c_str(), result.reason.c_str());
    return;
  }
  std::printf("%s: %s; %d lines, %.2f px\n",
              name.c_str(),
              DescribeKnownKeys(keys).c_str(),
              result.num_segments,
              result.rms_px);
}

int RunCalibrateLines(const LinesArguments& arguments) {
  const CommonOptions& common = arguments.calibration.common;
  const CalibrationScene scene = ReadCalibrationScene(arguments.calibration);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  size_t num_failed = 0;
  for (const CalibrationPhotograph& photograph : scene.photographs) {
    LinesResult result;
    KnownKeys keys;
    try {
      LinesOptions options = arguments.options;
      if (!options.aspect) FindAspect(scene, photograph, options);
      result = CalibrateLines(ReadGrey8(photograph.file), options, common.seed);
      keys = KeysOfLines(result, arguments.options);
      if (!common.dry_run) WriteKnownKeys(scene, photograph.name, keys, "lines");
    } catch (const Error& error) {
      ++num_failed;
      result = {};
      result.reason = error.what();
    }
    if (common.json) {
      json.push_back(JsonFromLines(photograph.name, result));
    } else {
      PrintLines(photograph.name, result, keys);
    }
  }
  if (common.json) PrintJson({{"photographs", json}});
  return ExitOfCalibration(num_failed, scene.photographs.size());
}

}  // namespace

void AddCalibrateLines(CLI::App* calibrate, int& exit_status) {
  auto arguments = std::make_shared<LinesArguments>();
  CLI::App* command = calibrate->add_subcommand(
      "lines", "View angle, roll, shift and k1 from a building's parallel and straight lines");
  AddCalibrationArguments(command, arguments->calibration);
  command
      ->add_option("--aspect",
                   arguments->options.aspect,
                   "width / height of the whole picture, if its pixels are not square and no tag "
                   "says it")
      ->check(Above(0));
  AddExample(command, "groundglass calibrate lines hall");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->calibration.common,
                                 [&] { return RunCalibrateLines(*arguments); });
  });
}

}  // namespace groundglass
