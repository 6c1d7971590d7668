// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/check_option.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace groundglass {

// What an options struct says against one of its fields, with the option as it was typed in place
// of the field: "groundglass run: --texel-size: must be at least 0, not -1". Nothing if no option
// of the command line filled the field: then it came from a file, and is no wrong usage.
std::optional<std::string> DescribeOptionFault(const CLI::App& app, const OptionError& error);

}  // namespace groundglass
