// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/error.h"

#include <CLI/CLI.hpp>

#include <string>

namespace groundglass {

// What was asked for is a part of Groundglass that this program was built without: that of
// ./demo.sh, which builds no more than it needs (GROUNDGLASS_EVERY_COMMAND=OFF), or one whose
// machine lacked the window's libraries. what() holds the command line that builds it.
class LeftOut : public Error {
 public:
  // what: the command and its option, as they are typed ("render --over"). missing_packages:
  // Debian's names of those that have to be installed first, with blanks between; mostly none.
  explicit LeftOut(const std::string& what, const std::string& missing_packages = "");
};

// The command line, for a shell in any folder, by which this build gets all that was left out.
std::string CommandThatBuildsEverything();

// Adds a command that stands in the help, and says with whatever words it is called that it was
// left out.
void AddLeftOutCommand(CLI::App& app,
                       const std::string& name,
                       const std::string& summary,
                       const std::string& missing_packages = "");

}  // namespace groundglass
