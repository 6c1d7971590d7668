// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/check_report.h"
#include "cli/commands.h"
#include "cli/job_printer.h"
#include "cli/json_output.h"
#include "cli/option_values.h"
#include "cli/register_arguments.h"
#include "cli/warnings_last.h"
#include "pipeline/register_stages.h"
#include "pipeline/stage_keys.h"
#include "pipeline/texture_stages.h"
#include "scene/formats/registration_io.h"

#include <cstdio>
#include <memory>

namespace groundglass {

void AddRegisterCommand(CLI::App& app, int& exit_status) {
  struct Arguments {
    CommonOptions common;
    RegisterArguments registering;
    std::vector<const CLI::Option*> options;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("register", "Correct the photographs' tags against the model's edges");
  arguments->options = OptionsAddedBy(command, [&] {
    AddRegisterArguments(command, arguments->registering);
    AddCommonOptions(command, arguments->common);
  });
  AddKeepOption(command, arguments->registering);
  AddExample(command, "groundglass register hall -o hall-out --sigma-lookat 0.5");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] {
      const RegisterArguments& registering = arguments->registering;
      registering.options.Check();
      const Scene scene = ReadSceneForCommand(registering, arguments->common);
      const WarningsLast warnings(scene.warnings, arguments->common.quiet);
      const StageInputs inputs =
          ReadRegistrationInputs(scene, ReadRegisterTexts(registering, arguments->options));
      const uint64_t seed = arguments->common.seed;
      const std::string key = RegistrationKey(seed, inputs);
      if (arguments->common.dry_run) {
        const std::vector<std::string> kept =
            FindKeptRegistration(registering.options, registering.out_folder, key);
        return TellDryRun(arguments->common,
                          "register " + std::to_string(scene.photographs.size()) +
                              " photographs into " + registering.out_folder.string() +
                              DescribeKept(kept),
                          {{"out", registering.out_folder.string()},
                           {"photographs", scene.photographs.size()},
                           {"faces", scene.model.faces.size()},
                           {"kept", kept},
                           {"warnings", scene.warnings}});
      }
      const FolderLock lock = PrepareOutputFolder(registering.out_folder);
      const JobObserver printer = MakeJobPrinter(arguments->common);
      TellDamagedManifest(registering.out_folder, printer);
      OutputStages stages(registering.out_folder, MakeManifest("register", seed, {inputs}));
      const bool is_other = !stages.IsFrom(kRegisterStage, key);
      for (const char* stage : {kRegisterStage, kOverlayStage}) stages.KeepOnly(stage, key);
      for (const char* stage : {kTextureStage, kTilesStage, kStillsStage, kReportStage}) {
        if (is_other) stages.KeepOnly(stage, "");
      }
      TellChanged(stages, {kRegisterStage, kOverlayStage}, printer);
      stages.Write();
      const RegisteredScene registered = EnsureRegistered(scene,
                                                          ReadLensArgument(registering),
                                                          ReadRegisterOptions(registering),
                                                          registering.out_folder,
                                                          key,
                                                          stages,
                                                          printer);
      EnsureOverlays(scene, registered, registering.out_folder, key, stages, printer);
      if (arguments->common.json) {
        PrintRegistrationsJson(registered, scene.warnings);
      } else {
        std::fputs(FormatModelSummary(scene.model, registering.model_arguments).c_str(), stdout);
        PrintRegistrations(registered.registrations);
        PrintModelErrors(registered.model_errors, scene.model);
        PrintVerdictCounts(registered.registrations, scene.warnings.size());
      }
      PrintWarnings(registered.warnings);
      return ExitStatusOf(registered.registrations);
    });
  });
}

}  // namespace groundglass
