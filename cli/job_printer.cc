// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/job_printer.h"

#include "cli/bake_arguments.h"
#include "pipeline/register_stages.h"
#include "pipeline/texture_stages.h"

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

namespace groundglass {
namespace {

// What is said of the stages that take long.
constexpr std::array<std::pair<std::string_view, const char*>, 4> kTitles = {{
    {kRegisterStage, "registering each alone"},
    {kOverlayStage, "drawing overlays"},
    {kTextureStage, "texturing"},
    {kStillsStage, "rendering"},
}};

}  // namespace

JobObserver MakeJobPrinter(const CommonOptions& common, int max_memory_mb) {
  JobObserver printer;
  printer.begun = [common, max_memory_mb](const std::string& stage) -> Progress {
    if (stage == kTextureStage) KeepFreedMemory(max_memory_mb);
    for (const auto& [of_stage, title] : kTitles) {
      if (stage == of_stage) return MakeProgress(common, title);
    }
    return {};
  };
  printer.kept = [common](const std::string& stage) {
    if (stage == kRegisterStage && !common.quiet) {
      std::fprintf(stderr, "keeping the tags that are there already\n");
    }
  };
  printer.told = [](const std::string& line) {
    std::fprintf(stderr, "groundglass: %s\n", line.c_str());
  };
  return printer;
}

std::string DescribeKept(const std::vector<std::string>& kept) {
  std::string list;
  for (const std::string& stage : kept) list += (list.empty() ? "" : ", ") + stage;
  return list.empty() ? "" : "\nwould keep what is there already of: " + list;
}

}  // namespace groundglass
