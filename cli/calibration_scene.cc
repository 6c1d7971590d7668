// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/calibration_scene.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/input_folders.h"
#include "scene/formats/metadata_lens.h"
#include "scene/text.h"

#include <algorithm>
#include <cstdio>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> FindModelFile(const fs::path& folder) {
  for (const char* extension : {".osu", ".obj", ".ply", ".stl", ".glb", ".gltf"}) {
    const fs::path file = folder / (std::string("model") + extension);
    if (fs::is_regular_file(file)) return file;
  }
  return std::nullopt;
}

std::string Rounded(const std::string& value) {
  const std::optional<double> number = ParseNumber(value);
  if (!number) return value;
  char text[40];
  std::snprintf(text, sizeof text, "%.5g", *number);
  return text;
}

}  // namespace

void AddCalibrationArguments(CLI::App* command, CalibrationArguments& arguments) {
  command->add_option("input", arguments.inputs, "a scene folder (its images/), or photographs")
      ->required();
  command
      ->add_option("-o,--out",
                   arguments.out_folder,
                   "where to write NAME.view; calibration/ of the scene folder if not given")
      ->type_name("FOLDER");
  command->add_option("--model", arguments.model_file, "the model, in place of the folder's own")
      ->type_name("FILE");
  AddModelOptions(command, arguments.model_arguments);
  AddCommonOptions(command, arguments.common);
}

CalibrationScene ReadCalibrationScene(const CalibrationArguments& arguments,
                                      const std::string& subfolder) {
  CalibrationScene scene;
  scene.out_folder = arguments.out_folder;
  std::optional<fs::path> model_file = arguments.model_file;
  if (arguments.inputs.size() == 1 && fs::is_directory(arguments.inputs.front())) {
    scene.scene_folder = arguments.inputs.front();
    const fs::path images = scene.scene_folder / subfolder;
    const std::vector<std::string> paths = ListImagePaths(images);
    const std::vector<std::string> names = NamePhotographs(paths);
    for (size_t i = 0; i < paths.size(); ++i) {
      scene.photographs.push_back({names[i], images / paths[i]});
    }
    if (scene.photographs.empty()) {
      throw Error(scene.scene_folder,
                  "no photographs; expected " + subfolder + "/ with pictures in it");
    }
    if (!model_file) model_file = FindModelFile(scene.scene_folder);
    if (scene.out_folder.empty()) scene.out_folder = scene.scene_folder / "calibration";
    RefuseAmongInputs(scene.out_folder);
  } else {
    for (const fs::path& file : arguments.inputs) {
      if (fs::is_directory(file)) throw Error(file, "give one scene folder, or photographs");
      scene.photographs.push_back({file.stem().string(), file});
    }
  }
  if (model_file) scene.model = ReadModel(*model_file, arguments.model_arguments.Options()).model;
  return scene;
}

std::optional<VideoAspect> VideoAspectOf(const fs::path& file, const FrameOptions& options) {
  const PhotographMetadata metadata = ReadPhotographMetadata(file);
  const bool is_digital = metadata.made_by == PictureMaker::kDigitalCamera;
  if (is_digital && FindMetadataLens(metadata).view_angle_deg) return std::nullopt;
  return FindVideoAspect(metadata.size.width, metadata.size.height, options);
}

void WriteKnownKeys(const CalibrationScene& scene,
                    const std::string& photograph,
                    const KnownKeys& keys,
                    const std::string& source) {
  if (scene.out_folder.empty()) return;
  const fs::path file = scene.out_folder / (photograph + ".view");
  const KnownKeys before = fs::exists(file) ? ReadKnownKeys(file) : KnownKeys();
  const KnownKeys merged = MergeKnownKeys(before, keys, source);
  if (merged.empty() && before.empty()) return;
  WriteFileAtomically(file,
                      FormatKnownKeys(merged,
                                      "What `groundglass calibrate` found of " + photograph +
                                          ".\nA number of its tag in views/ wins."));
}

std::string DescribeKnownKeys(const KnownKeys& keys) {
  std::string text;
  std::string last;  // the number before
  for (const KnownKey& key : keys) {
    const bool is_its_sigma =
        key.key.starts_with("sigma_") && last.starts_with(key.key.substr(sizeof("sigma_") - 1));
    if (is_its_sigma) {
      text += " +- " + Rounded(key.value);
    } else {
      text += (text.empty() ? "" : ", ") + key.key + " " + Rounded(key.value);
    }
    last = key.key;
  }
  return text;
}

}  // namespace groundglass
