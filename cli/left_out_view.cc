// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Compiled in place of view_command.cc where the window is not built.
#include "cli/commands.h"
#include "cli/left_out.h"

namespace groundglass {

void AddViewCommand(CLI::App& app, int&) {
  AddLeftOutCommand(app, "view", kViewSummary, GROUNDGLASS_MISSING_WINDOW_PACKAGES);
}

}  // namespace groundglass
