// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"

#include <cstddef>

namespace groundglass {

// Each adds a subcommand of `calibrate`. One file each.
void AddCalibrateBoard(CLI::App* calibrate, int& exit_status);
void AddCalibrateExport(CLI::App* calibrate, int& exit_status);
void AddCalibrateFrame(CLI::App* calibrate, int& exit_status);
void AddCalibrateLens(CLI::App* calibrate, int& exit_status);
void AddCalibrateLines(CLI::App* calibrate, int& exit_status);
void AddCalibrateTags(CLI::App* calibrate, int& exit_status);

// The exit status of a subcommand that could not do its work for so many of the photographs.
inline int ExitOfCalibration(size_t num_failed, size_t num_photographs) {
  if (num_failed == 0) return kExitDone;
  return num_failed == num_photographs ? kExitWrongInput : kExitNeedsReview;
}

}  // namespace groundglass
