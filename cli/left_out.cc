// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/left_out.h"

#include "scene/shell_word.h"

namespace groundglass {

LeftOut::LeftOut(const std::string& what, const std::string& missing_packages)
    : Error(what + ": not in this build of groundglass; " +
            (missing_packages.empty() ? "" : "install " + missing_packages + ", then ") +
            "this builds it: " + CommandThatBuildsEverything()) {}

std::string CommandThatBuildsEverything() {
  const std::string folder = ShellWord(GROUNDGLASS_BUILD_FOLDER);
  return "cmake -D GROUNDGLASS_EVERY_COMMAND=ON " + folder + " && cmake --build " + folder +
         " --target groundglass";
}

void AddLeftOutCommand(CLI::App& app,
                       const std::string& name,
                       const std::string& summary,
                       const std::string& missing_packages) {
  CLI::App* command = app.add_subcommand(name, summary + " (not in this build)");
  command->allow_extras();
  const LeftOut left_out(name, missing_packages);
  command->footer(left_out.what());
  command->callback([left_out] { throw left_out; });
}

}  // namespace groundglass
