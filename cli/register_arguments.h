// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "cli/model_arguments.h"
#include "register/register_scene.h"
#include "scene/output_folder.h"
#include "scene/scene_folder.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What `register` and `run` share: the options, and the step from a scene to corrected tags.
struct RegisterArguments {
  std::filesystem::path scene_folder;
  std::filesystem::path out_folder;
  std::optional<std::filesystem::path> model_file;
  ModelArguments model_arguments;
  std::optional<std::filesystem::path> lens_file;
  std::optional<std::filesystem::path> points_file;
  std::vector<std::string> only;  // photographs by name; empty: all
  RegisterOptions options;
};
void AddRegisterArguments(CLI::App* command, RegisterArguments& arguments);

// Reads the scene, what is odd about it among its warnings (they are told last: WarningsLast), and
// leaves the photographs that are asked for.
// Names that it does not have are an Error.
Scene ReadSceneForCommand(const RegisterArguments& arguments, const CommonOptions& common);

// The inputs' hashes and the options, for manifest.json.
Manifest DescribeInputs(const std::string& command,
                        const Scene& scene,
                        const RegisterArguments& arguments,
                        const CommonOptions& common);

// Registers the scene and writes views/, registration.json, cameras/ and overlays/.
RegisteredScene RegisterAndWrite(const Scene& scene,
                                 const RegisterArguments& arguments,
                                 const CommonOptions& common);

// The table that a person reads: verdict, how far the picture moved, score, reasons.
void PrintRegistrations(const std::vector<Registration>& registrations);
// How many have which verdict, and how many warnings there are.
void PrintVerdictCounts(const std::vector<Registration>& registrations, size_t num_warnings);
// registration.json as it is written, with the warnings.
void PrintRegistrationsJson(const RegisteredScene& registered,
                            const std::vector<std::string>& warnings);
// The lines of the model that are off, if any, in `site`.
void PrintModelErrors(const std::vector<ModelError>& model_errors, LengthUnit unit);

// 0 if all were accepted, else 3.
int ExitStatusOf(const std::vector<Registration>& registrations);

}  // namespace groundglass
