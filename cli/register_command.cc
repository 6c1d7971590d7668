// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/check_report.h"
#include "cli/commands.h"
#include "cli/register_arguments.h"
#include "cli/warnings_last.h"

#include <cstdio>
#include <memory>

namespace groundglass {

void AddRegisterCommand(CLI::App& app, int& exit_status) {
  struct Arguments {
    CommonOptions common;
    RegisterArguments registering;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("register", "Correct the photographs' tags against the model's edges");
  AddRegisterArguments(command, arguments->registering);
  AddCommonOptions(command, arguments->common);
  AddExample(command, "groundglass register hall -o hall-out --sigma-lookat 0.5");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] {
      const RegisterArguments& registering = arguments->registering;
      registering.options.Check();
      const Scene scene = ReadSceneForCommand(registering, arguments->common);
      const WarningsLast warnings(scene.warnings, arguments->common.quiet);
      if (arguments->common.dry_run) {
        std::printf("would register %zu photographs into %s\n",
                    scene.photographs.size(),
                    registering.out_folder.string().c_str());
        return kExitDone;
      }
      PrepareOutputFolder(registering.out_folder);
      WriteManifest(registering.out_folder,
                    DescribeInputs("register", scene, registering, arguments->common));
      const RegisteredScene registered = RegisterAndWrite(scene, registering, arguments->common);
      if (arguments->common.json) {
        PrintRegistrationsJson(registered, scene.warnings);
      } else {
        std::fputs(FormatModelSummary(scene.model, registering.model_arguments).c_str(), stdout);
        PrintRegistrations(registered.registrations);
        PrintModelErrors(registered.model_errors, scene.model.unit);
        PrintVerdictCounts(registered.registrations, scene.warnings.size());
      }
      return ExitStatusOf(registered.registrations);
    });
  });
}

}  // namespace groundglass
