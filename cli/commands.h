// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/progress.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace groundglass {

// Exit statuses (docs/output-folder.md).
constexpr int kExitDone = 0;
constexpr int kExitWrongInput = 1;
constexpr int kExitWrongUsage = 2;
constexpr int kExitNeedsReview = 3;

// What every subcommand takes.
struct CommonOptions {
  bool json = false;     // machine-readable result on stdout
  bool quiet = false;    // no progress
  bool dry_run = false;  // say what would be done, write nothing
  int threads = 0;       // 0: every core
  uint64_t seed = 1988;
};

// Adds the common flags to a subcommand.
void AddCommonOptions(CLI::App* command, CommonOptions& options);

// Ends a subcommand's help with a command line to copy.
void AddExample(CLI::App* command, const std::string& example);
// An option that takes one of a few words, which its help lists.
CLI::Option* AddChoice(CLI::App* command,
                       const std::string& name,
                       const std::vector<std::string>& words,
                       const std::string& description,
                       std::string& word);

// Runs `work` with no more than options.threads threads.
int RunWithThreads(const CommonOptions& options, const std::function<int()>& work);

// Progress on stderr: one line with rate and time left that is drawn over on a terminal, plain
// lines elsewhere, nothing if quiet.
Progress MakeProgress(const CommonOptions& options, const std::string& title);

// What the help says of the commands that a build may leave out: these stand in it all the same
// (left_out_commands.cc, left_out_view.cc).
constexpr const char* kCalibrateSummary =
    "What a camera, a slide and a photograph know of themselves";
constexpr const char* kViewSummary =
    "A window: look around, find a photograph's camera by hand, ask what is where";
constexpr const char* kWhereSummary =
    "Where a point is, how sure that is, and which photographs show it";
constexpr const char* kSynthSummary =
    "Make a scene with known answers: model, photographs, tags, truth";

// Each adds its subcommand; when it has run, `exit_status` holds what main returns. One file each.
void AddRunCommand(CLI::App& app, int& exit_status);
void AddCheckCommand(CLI::App& app, int& exit_status);
void AddCalibrateCommand(CLI::App& app, int& exit_status);
void AddRegisterCommand(CLI::App& app, int& exit_status);
void AddInvrenderCommand(CLI::App& app, int& exit_status);
void AddRenderCommand(CLI::App& app, int& exit_status);
void AddViewCommand(CLI::App& app, int& exit_status);
void AddWhereCommand(CLI::App& app, int& exit_status);
void AddSynthCommand(CLI::App& app, int& exit_status);
void AddEvaluateCommand(CLI::App& app, int& exit_status);
void AddConvertCommand(CLI::App& app, int& exit_status);

}  // namespace groundglass
