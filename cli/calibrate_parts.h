// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"

namespace groundglass {

// Each adds a subcommand of `calibrate`. One file each.
void AddCalibrateBoard(CLI::App* calibrate, int& exit_status);
void AddCalibrateExport(CLI::App* calibrate, int& exit_status);
void AddCalibrateFrame(CLI::App* calibrate, int& exit_status);
void AddCalibrateLens(CLI::App* calibrate, int& exit_status);
void AddCalibrateLines(CLI::App* calibrate, int& exit_status);
void AddCalibrateTags(CLI::App* calibrate, int& exit_status);

}  // namespace groundglass
