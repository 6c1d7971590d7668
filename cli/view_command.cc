// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/model_arguments.h"
#include "cli/option_range.h"
#include "gui/window.h"

#include <csignal>
#include <filesystem>
#include <memory>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  fs::path folder;
  fs::path scene;
  int width_px = 1500;
  int height_px = 1000;
  double scale = 1;
  fs::path test_log;
};

int RunView(const ViewArguments& arguments) {
  WindowOptions options;
  options.folder = arguments.folder;
  options.scene_folder = arguments.scene;
  options.model = arguments.model_arguments.Options();
  options.width_px = arguments.width_px;
  options.height_px = arguments.height_px;
  options.text_scale = arguments.scale;
  options.test_log = arguments.test_log;
  if (arguments.common.dry_run) {
    return TellDryRun(arguments.common,
                      "open a window on " + arguments.folder.string(),
                      {{"folder", arguments.folder.string()}});
  }
  // SDL turns them into the question what is to become of unsaved work, unless somebody else
  // handles them.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  RunWindow(options);
  return kExitDone;
}

}  // namespace

void AddViewCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand("view", kViewSummary);
  command->add_option("folder", arguments->folder, "a scene, an output folder, or a model")
      ->required();
  command->add_option("--scene", arguments->scene, "where the photographs of an output folder are");
  command->add_option("--width", arguments->width_px, "of the window, px")
      ->check(FromTo(320, 16384))
      ->capture_default_str();
  command->add_option("--height", arguments->height_px, "of the window, px")
      ->check(FromTo(240, 16384))
      ->capture_default_str();
  command->add_option("--scale", arguments->scale, "of text and panels")
      ->check(FromTo(0.5, 3))
      ->capture_default_str();
  command->add_option("--test-log", arguments->test_log, "for tests: a line for each Pause key")
      ->group("");
  AddModelOptions(command, arguments->model_arguments);
  AddCommonOptions(command, arguments->common);
  AddExample(command,
             "groundglass view hall\n"
             "  groundglass view hall-out --scene hall");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return RunView(*arguments); });
  });
}

}  // namespace groundglass
