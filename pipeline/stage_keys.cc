// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "pipeline/stage_keys.h"

#include "scene/error.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// By its path from the scene's folder, so that the scene may lie anywhere.
void AddFile(const Scene& scene, const fs::path& file, StageInputs& inputs) {
  const fs::path relative = file.lexically_relative(scene.folder);
  const bool is_inside = !relative.empty() && *relative.begin() != "..";
  std::string& hash =
      inputs.sha256_of_inputs[(is_inside ? relative : file.filename()).generic_string()];
  try {
    hash = HashFile(file);
  } catch (const Error&) {
    hash = "unreadable";
  }
}

void AddRegistrationFiles(const Scene& scene, const Photograph& photograph, StageInputs& inputs) {
  AddFile(scene, photograph.image_file, inputs);
  if (!photograph.view_file.empty()) AddFile(scene, photograph.view_file, inputs);
  if (photograph.mask_file) AddFile(scene, *photograph.mask_file, inputs);
  if (photograph.calibration_file) AddFile(scene, *photograph.calibration_file, inputs);
}

}  // namespace

StageInputs ReadStageOptions(const OptionTexts& options) {
  StageInputs inputs;
  inputs.options = options.values;
  for (const auto& [name, file] : options.files) inputs.sha256_of_inputs[name] = HashFile(file);
  return inputs;
}

StageInputs ReadRegistrationInputs(const Scene& scene, const OptionTexts& options) {
  StageInputs inputs = ReadStageOptions(options);
  AddFile(scene, scene.model_file, inputs);
  for (const fs::path& file : scene.camera_files) AddFile(scene, file, inputs);
  for (const fs::path& file : scene.lens_files) AddFile(scene, file, inputs);
  for (const Photograph& photograph : scene.photographs) {
    AddRegistrationFiles(scene, photograph, inputs);
  }
  // What is mended is to be done again, so all that may be at fault counts.
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    AddRegistrationFiles(scene, unreadable.photograph, inputs);
    if (unreadable.photograph.faces_file) {
      AddFile(scene, *unreadable.photograph.faces_file, inputs);
    }
  }
  const fs::path table = scene.folder / "tags.csv";
  if (fs::exists(table)) AddFile(scene, table, inputs);
  return inputs;
}

StageInputs ReadTextureInputs(const Scene& scene, const OptionTexts& options) {
  StageInputs inputs = ReadStageOptions(options);
  for (const Photograph& photograph : scene.photographs) {
    if (photograph.faces_file) AddFile(scene, *photograph.faces_file, inputs);
  }
  const fs::path pairs = scene.folder / "pairs.csv";
  if (fs::exists(pairs)) AddFile(scene, pairs, inputs);
  return inputs;
}

std::string StageKey(const std::string& stage,
                     const std::string& key_before,
                     const StageInputs& inputs) {
  using Json = nlohmann::ordered_json;
  const Json json = {
      GROUNDGLASS_VERSION, stage, key_before, inputs.options, inputs.sha256_of_inputs};
  return HashText(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string RegistrationKey(uint64_t seed, const StageInputs& inputs) {
  return StageKey("register", std::to_string(seed), inputs);
}

Manifest MakeManifest(const std::string& command,
                      uint64_t seed,
                      const std::vector<StageInputs>& inputs) {
  Manifest manifest;
  manifest.version = GROUNDGLASS_VERSION;
  manifest.command = command;
  manifest.seed = seed;
  for (const StageInputs& stage : inputs) {
    manifest.options.insert(stage.options.begin(), stage.options.end());
    manifest.sha256_of_inputs.insert(stage.sha256_of_inputs.begin(), stage.sha256_of_inputs.end());
  }
  return manifest;
}

}  // namespace groundglass
