// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"

#include <nlohmann/json.hpp>

#include <string>

namespace groundglass {

// One object on stdout, for a program that asked for it with --json. File names may be of any
// bytes.
void PrintJson(const nlohmann::ordered_json& json);

// What --dry-run says: "would WORDS", or the object with "written": false before all else.
int TellDryRun(const CommonOptions& common,
               const std::string& words,
               const nlohmann::ordered_json& json);

}  // namespace groundglass
