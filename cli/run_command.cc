// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/bake_arguments.h"
#include "cli/check_report.h"
#include "cli/commands.h"
#include "cli/job_printer.h"
#include "cli/json_output.h"
#include "cli/option_range.h"
#include "cli/option_values.h"
#include "cli/register_arguments.h"
#include "cli/warnings_last.h"
#include "pipeline/main_job.h"
#include "pipeline/photograph_selection.h"
#include "scene/formats/unfinished_files.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// The options of each stage, as the parser has them.
struct StageOptions {
  std::vector<const CLI::Option*> registering;
  std::vector<const CLI::Option*> texture;
  std::vector<const CLI::Option*> tiles;
  std::vector<const CLI::Option*> stills;
};

struct RunArguments {
  CommonOptions common;
  RegisterArguments registering;
  BakeArguments baking;
  int num_stills = 4;
  StageOptions options;
};

void PrintPlaces(const fs::path& out, const ImageSize& stills) {
  const std::pair<const char*, const char*> places[] = {{"corrected tags", "views"},
                                                        {"overlays", "overlays"},
                                                        {"textured model", "model.glb"},
                                                        {"new viewpoints", "renders"},
                                                        {"the whole story", "report.html"}};
  std::printf("\n");
  for (const auto& [what, name] : places) {
    std::error_code error;
    if (!fs::exists(out / name, error) || fs::is_empty(out / name, error)) continue;
    const bool is_stills = std::string_view(name) == "renders" && stills.width > 0;
    const std::string size =
        " (" + std::to_string(stills.width) + " x " + std::to_string(stills.height) + " pixels)";
    std::printf("%-16s %s%s\n", what, (out / name).string().c_str(), is_stills ? size.c_str() : "");
  }
}

// With the files that the options name read.
MainJobOptions ReadMainJobOptions(const RunArguments& arguments) {
  const BakeArguments& baking = arguments.baking;
  const StageOptions& options = arguments.options;
  MainJobOptions job;
  job.registering = ReadRegisterOptions(arguments.registering);
  job.lens = ReadLensArgument(arguments.registering);
  job.baking = baking.Options();
  job.selection = baking.selection;
  job.page_format = baking.format;
  job.tiles = baking.Tiles();
  job.num_stills = arguments.num_stills;
  job.seed = arguments.common.seed;
  job.texts = {ReadRegisterTexts(arguments.registering, options.registering),
               ReadOptionTexts(options.texture),
               ReadOptionTexts(options.tiles),
               ReadOptionTexts(options.stills)};
  return job;
}

// The job's own words, and on stdout, for a person, what it finds while the long work goes on.
JobObserver MakeRunPrinter(const RunArguments& arguments, const Scene& scene) {
  JobObserver printer =
      MakeJobPrinter(arguments.common, arguments.baking.options.memory.max_memory_mb);
  if (arguments.common.json) return printer;
  printer.registered = [&](const RegisteredScene& registered) {
    std::fputs(FormatModelSummary(scene.model, arguments.registering.model_arguments).c_str(),
               stdout);
    PrintRegistrations(registered.registrations);
    PrintModelErrors(registered.model_errors, scene.model);
  };
  printer.textured = [](double covered_share) {
    std::printf("texture covers %.1f %% of the model's surface\n", 100 * covered_share);
  };
  return printer;
}

// What would be done, what is there already, and which photographs would be left out.
int DryRun(const RunArguments& arguments, const Scene& scene) {
  const fs::path& out = arguments.registering.out_folder;
  const std::vector<std::string> left_out = CheckSelection(arguments.baking.selection, scene);
  PrintWarnings(left_out);
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), left_out.begin(), left_out.end());
  const std::vector<std::string> kept = FindKeptStages(scene, out, ReadMainJobOptions(arguments));
  std::vector<std::string> unreadable;
  for (const UnreadablePhotograph& photograph : scene.unreadable) {
    unreadable.insert(unreadable.end(), photograph.reasons.begin(), photograph.reasons.end());
  }
  std::string words = "register " + std::to_string(scene.photographs.size()) +
                      " photographs, bake " + std::to_string(scene.model.faces.size()) +
                      " faces and write " + out.string();
  words += DescribeKept(kept);
  if (!scene.unreadable.empty()) {
    words +=
        "\nwould leave out " + std::to_string(scene.unreadable.size()) + " that cannot be read:";
    for (const std::string& reason : unreadable) words += "\n  " + reason;
  }
  return TellDryRun(arguments.common,
                    words,
                    {{"out", out.string()},
                     {"photographs", scene.photographs.size()},
                     {"faces", scene.model.faces.size()},
                     {"kept", kept},
                     {"unreadable", unreadable},
                     {"warnings", warnings}});
}

int Run(const RunArguments& arguments) {
  const RegisterArguments& registering = arguments.registering;
  const BakeArguments& baking = arguments.baking;
  const CommonOptions& common = arguments.common;
  const fs::path& out = registering.out_folder;
  registering.options.Check();
  baking.options.Check();
  baking.Options();  // wrong usage is told before anything is read
  const WordsOnInterrupt words("groundglass: stopped; the same command goes on from here");
  const Scene scene = ReadSceneForCommand(registering, common, baking.selection.exclude);
  const WarningsLast warnings(scene.warnings, common.quiet);
  if (common.dry_run) {
    return DryRun(arguments, scene);
  }
  const MainJobResult result =
      RunMainJob(scene, out, ReadMainJobOptions(arguments), MakeRunPrinter(arguments, scene));
  const std::vector<Registration>& registrations = result.registered.registrations;
  if (common.json) {
    std::vector<std::string> told = scene.warnings;
    told.insert(told.end(), result.remarks.begin(), result.remarks.end());
    told.insert(told.end(), result.selection_faults.begin(), result.selection_faults.end());
    PrintRegistrationsJson(result.registered, told, result.failures);
  } else {
    PrintVerdictCounts(registrations, scene.warnings.size());
    PrintPlaces(out, result.stills);
    for (const std::string& failure : result.failures) {
      std::printf("NOT FINISHED     %s\n", failure.c_str());
    }
  }
  PrintWarnings(result.remarks);
  PrintWarnings(result.registered.warnings);
  PrintWarnings(result.selection_faults);
  if (!result.failures.empty()) return kExitWrongInput;
  return result.selection_faults.empty() ? ExitStatusOf(registrations) : kExitNeedsReview;
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand(
      "run", "The main job: correct the tags, texture the model, report what was found");
  StageOptions& options = arguments->options;
  options.registering =
      OptionsAddedBy(command, [&] { AddRegisterArguments(command, arguments->registering); });
  options.texture = OptionsAddedBy(command, [&] { AddBakeArguments(command, arguments->baking); });
  options.tiles = OptionsAddedBy(command, [&] { AddTileArguments(command, arguments->baking); });
  options.stills = OptionsAddedBy(command, [&] {
    command->add_option("--stills", arguments->num_stills, "pictures from new viewpoints")
        ->capture_default_str()
        ->check(FromTo(0, 100));
  });
  const std::vector<const CLI::Option*> common =
      OptionsAddedBy(command, [&] { AddCommonOptions(command, arguments->common); });
  options.registering.insert(options.registering.end(), common.begin(), common.end());
  AddKeepOption(command, arguments->registering);
  AddExample(command, "groundglass run hall -o hall-out");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return Run(*arguments); });
  });
}

}  // namespace groundglass
