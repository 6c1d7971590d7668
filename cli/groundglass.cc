// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/groundglass.h"

#include "cli/bake_arguments.h"
#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/left_out.h"
#include "cli/option_fault.h"
#include "cli/suggestion.h"
#include "scene/error.h"
#include "scene/formats/unfinished_files.h"
#include "scene/what_failed.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>

namespace groundglass {
namespace {

// One line for the person at the keyboard; an object for a program that asked for one.
int Fail(int exit_status, const std::string& message, bool as_json) {
  std::fprintf(stderr, "groundglass: %s\n", message.c_str());
  if (as_json) PrintJson({{"error", message}, {"exit", exit_status}});
  return exit_status;
}

// Without the program's own name, which every line of ours begins with.
std::string WithoutProgramName(const std::string& message) {
  constexpr std::string_view kName = "groundglass";
  if (message.rfind(kName, 0) != 0) return message;
  const size_t rest = message.find_first_not_of(" :", kName.size());
  return rest == std::string::npos ? message : message.substr(rest);
}

}  // namespace

int RunGroundglass(int argc, char** argv) {
  KeepFreedMemory(0);
  // A limit on file sizes is a full disk: an error like any other, not the end on the spot.
  std::signal(SIGXFSZ, SIG_IGN);
  RemoveUnfinishedFilesOnSignals();
  CLI::App app{
      "Groundglass corrects hand-measured camera tags against a polygon model, and turns the\n"
      "photographs into a textured model.",
      "groundglass"};
  app.set_version_flag("--version", "groundglass " GROUNDGLASS_VERSION);
  app.require_subcommand(1);
  AddExample(&app,
             "groundglass check hall -o hall-check    what is wrong, and what to do\n"
             "  groundglass run hall -o hall-out        the whole job\n"
             "  groundglass help run                    each command has its own help");
  int exit_status = kExitDone;
  AddRunCommand(app, exit_status);
  AddCheckCommand(app, exit_status);
  AddCalibrateCommand(app, exit_status);
  AddRegisterCommand(app, exit_status);
  AddInvrenderCommand(app, exit_status);
  AddRenderCommand(app, exit_status);
  AddViewCommand(app, exit_status);
  AddWhereCommand(app, exit_status);
  AddSynthCommand(app, exit_status);
  AddEvaluateCommand(app, exit_status);
  AddConvertCommand(app, exit_status);
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty()) {
    std::fputs(app.help().c_str(), stdout);
    return kExitWrongUsage;
  }
  // "help run" is "run --help".
  if (words.front() == "help") {
    words.erase(words.begin());
    words.push_back("--help");
  }
  const bool as_json = std::find(words.begin(), words.end(), "--json") != words.end();
  // Most often a shell's variable that is not set; an option would take it for none.
  const auto empty = std::find(words.begin(), words.end(), "");
  if (empty != words.end()) {
    const std::string before = empty == words.begin() ? "" : " after " + *(empty - 1);
    return Fail(
        kExitWrongUsage,
        "an empty word on the command line" + before + "; leave it out, or say what is meant",
        as_json);
  }
  if (const auto unknown = FindUnknownCommand(app, words)) {
    return Fail(kExitWrongUsage, WithoutProgramName(*unknown), as_json);
  }
  try {
    // The last word first, as the library takes them.
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success& success) {
    return app.exit(success) == 0 ? kExitDone : kExitWrongUsage;
  } catch (const CLI::ParseError& error) {
    return Fail(kExitWrongUsage, WithoutProgramName(DescribeUsageError(app, error)), as_json);
  } catch (const OptionError& error) {
    const std::optional<std::string> usage = DescribeOptionFault(app, error);
    return usage ? Fail(kExitWrongUsage, WithoutProgramName(*usage), as_json)
                 : Fail(kExitWrongInput, error.what(), as_json);
  } catch (const LeftOut& error) {
    return Fail(kExitWrongUsage, error.what(), as_json);
  } catch (const std::exception& error) {
    return Fail(kExitWrongInput, WhatFailed(error), as_json);
  }
  // What was printed may be what somebody asked for, and lost.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return Fail(
        kExitWrongInput,
        "cannot write standard output: the disk that it goes to may be full, or the program "
        "that reads it has ended",
        false);
  }
  return exit_status;
}

}  // namespace groundglass
