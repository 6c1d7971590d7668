// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "scene/formats/output_folder.h"
#include "scene/formats/scene_folder.h"

#include <map>
#include <string>
#include <vector>

namespace groundglass {

// The options of each stage of the main job, as the parser has them.
struct StageOptions {
  std::vector<const CLI::Option*> registering;
  std::vector<const CLI::Option*> texture;
  std::vector<const CLI::Option*> tiles;
  std::vector<const CLI::Option*> stills;
};

// What the files of a stage depend on, beside the stage before it.
struct StageInputs {
  std::map<std::string, std::string> options;
  std::map<std::string, std::string> sha256_of_inputs;
};

// The options alone, with the files that they name.
StageInputs ReadStageOptions(const std::vector<const CLI::Option*>& options);
// With the files of the scene that registration reads: model, tags, photographs, masks.
StageInputs ReadRegistrationInputs(const Scene& scene,
                                   const std::vector<const CLI::Option*>& options);
// With those that only texturing reads: painted face masks, pairs.csv.
StageInputs ReadTextureInputs(const Scene& scene, const std::vector<const CLI::Option*>& options);

// Another key for everything that could make the stage's files differ (OutputStages).
std::string StageKey(const std::string& stage,
                     const std::string& key_before,
                     const StageInputs& inputs);

// The first stage's: the seed counts from there on.
std::string RegistrationKey(const CommonOptions& common, const StageInputs& inputs);

// A manifest of this program, with all these inputs.
Manifest MakeManifest(const std::string& command,
                      const CommonOptions& common,
                      const std::vector<StageInputs>& inputs);

}  // namespace groundglass
