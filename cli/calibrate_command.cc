// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/calibrate_parts.h"
#include "cli/commands.h"

namespace groundglass {

void AddCalibrateCommand(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("calibrate", kCalibrateSummary);
  command->require_subcommand(1);
  AddExample(command,
             "groundglass calibrate board board-1.jpg board-2.jpg board-3.jpg -o my.lens\n"
             "  groundglass calibrate lens hall");
  AddCalibrateBoard(command, exit_status);
  AddCalibrateLens(command, exit_status);
  AddCalibrateLines(command, exit_status);
  AddCalibrateFrame(command, exit_status);
  AddCalibrateTags(command, exit_status);
  AddCalibrateExport(command, exit_status);
}

}  // namespace groundglass
