// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "cli/model_arguments.h"
#include "cli/option_values.h"
#include "register/register.h"
#include "scene/formats/scene_folder.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What `register` and `run` share: the options, and the reading of the scene.
struct RegisterArguments {
  std::filesystem::path scene_folder;
  std::filesystem::path out_folder;
  std::optional<std::filesystem::path> views_folder;  // cameras in place of the scene's tags
  std::optional<std::filesystem::path> model_file;
  ModelArguments model_arguments;
  std::optional<std::filesystem::path> lens_file;
  std::optional<std::filesystem::path> points_file;
  std::vector<std::string> only;  // photographs by name; empty: all
  std::string ties = "patches";   // none, patches, colmap or both
  RegisterOptions options;
};
void AddRegisterArguments(CLI::App* command, RegisterArguments& arguments);
// --keep, which changes nothing of what is found, and so is no part of a stage's key.
void AddKeepOption(CLI::App* command, RegisterArguments& arguments);

// What the arguments come to, with the files that they name read. Error for one at fault.
RegisterOptions ReadRegisterOptions(const RegisterArguments& arguments);
// What the options are set to, for telling what can be kept; with COLMAP's version where it is
// used.
OptionTexts ReadRegisterTexts(const RegisterArguments& arguments,
                              const std::vector<const CLI::Option*>& options);
std::optional<Lens> ReadLensArgument(const RegisterArguments& arguments);

// Reads the scene, what is odd about it among its warnings (they are told last: WarningsLast; what
// lets nothing fit is told at once too, but in a dry run), and leaves the photographs that are
// asked for. Names that it does not have are an Error. not_needed: photographs whose faults do not
// matter.
Scene ReadSceneForCommand(const RegisterArguments& arguments,
                          const CommonOptions& common,
                          const std::vector<std::string>& not_needed = {});

// The table that a person reads: verdict, how far the picture moved, how its edges scatter about
// the model's (root mean square, and robustly), score, margin over the second-best, reasons.
void PrintRegistrations(const std::vector<Registration>& registrations);
// How many have which verdict, and how many warnings there are.
void PrintVerdictCounts(const std::vector<Registration>& registrations, size_t num_warnings);
// registration.json as it is written, with the warnings, and what could not be finished.
void PrintRegistrationsJson(const RegisteredScene& registered,
                            const std::vector<std::string>& warnings,
                            const std::vector<std::string>& failures = {});
// The lines of the model that are off, if any, in `site`.
void PrintModelErrors(const std::vector<ModelError>& model_errors, const PolygonModel& model);

// On stderr, each as a line.
void PrintWarnings(const std::vector<std::string>& warnings);

// 0 if all were accepted, else 3.
int ExitStatusOf(const std::vector<Registration>& registrations);

}  // namespace groundglass
