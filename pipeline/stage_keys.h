// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/output_folder.h"
#include "scene/formats/scene_folder.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace groundglass {

// What the options of a stage are set to, for manifest.json and for telling whether what was made
// with them can be kept. Whatever changes what is written belongs here.
struct OptionTexts {
  std::map<std::string, std::string> values;  // by the option's name
  // Files that options name count by what is in them: "--lens/nikon.lens" and where it lies.
  std::map<std::string, std::filesystem::path> files;
};

// What the files of a stage depend on, beside the stage before it.
struct StageInputs {
  std::map<std::string, std::string> options;
  std::map<std::string, std::string> sha256_of_inputs;
};

// The options alone, with the files that they name. Error for one of these that cannot be read.
StageInputs ReadStageOptions(const OptionTexts& options);
// With the files of the scene that registration reads: model, tags, photographs, masks.
StageInputs ReadRegistrationInputs(const Scene& scene, const OptionTexts& options);
// With those that only texturing reads: painted face masks, pairs.csv.
StageInputs ReadTextureInputs(const Scene& scene, const OptionTexts& options);

// Another key for everything that could make the stage's files differ (OutputStages).
std::string StageKey(const std::string& stage,
                     const std::string& key_before,
                     const StageInputs& inputs);

// The first stage's: the seed counts from there on.
std::string RegistrationKey(uint64_t seed, const StageInputs& inputs);

// A manifest of this program, with all these inputs.
Manifest MakeManifest(const std::string& command,
                      uint64_t seed,
                      const std::vector<StageInputs>& inputs);

}  // namespace groundglass
