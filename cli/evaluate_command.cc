// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"

namespace groundglass {

void AddEvaluateCommand(CLI::App&, int&) {}

}  // namespace groundglass
