// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// The command that was parsed last: "calibrate board" of its words.
const CLI::App& InnermostCommand(const CLI::App& app);
// "groundglass run: MESSAGE (groundglass run --help)".
std::string WithHelp(const CLI::App& command, const std::string& message);

// What is wrong with a command line that could not be parsed, in one line: the word that is at
// fault, and what it was most likely meant to be.
std::string DescribeUsageError(const CLI::App& app, const CLI::ParseError& error);
// The same before parsing, for a first word that is no command; nothing if there is none.
std::optional<std::string> FindUnknownCommand(const CLI::App& app,
                                              const std::vector<std::string>& words);

}  // namespace groundglass
