// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Compiled with GROUNDGLASS_EVERY_COMMAND=OFF, in place of the files that need the rooms which are
// not built then: cli/CMakeLists.txt has both lists.
#include "cli/commands.h"
#include "cli/convert_arguments.h"
#include "cli/elevation_arguments.h"
#include "cli/evaluate_arguments.h"
#include "cli/left_out.h"
#include "cli/montage_arguments.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Whether `exchange` would read it: an output folder, a folder of fSpy's projects, or a file that
// is no model of the kinds that `scene` reads.
bool IsForExchange(const fs::path& input) {
  if (fs::is_directory(input)) {
    return fs::exists(input / "registration.json") ||
           std::any_of(fs::directory_iterator(input), {}, [](const fs::directory_entry& entry) {
             return EndsIn(entry.path().string(), ".fspy");
           });
  }
  constexpr std::string_view kForExchange[] = {".fspy", ".gml", ".json", ".mlp", ".xml"};
  return std::any_of(std::begin(kForExchange), std::end(kForExchange), [&](std::string_view end) {
    return EndsIn(input.string(), end);
  });
}

}  // namespace

void AddCalibrateCommand(CLI::App& app, int&) {
  AddLeftOutCommand(app, "calibrate", kCalibrateSummary);
}

void AddWhereCommand(CLI::App& app, int&) { AddLeftOutCommand(app, "where", kWhereSummary); }

void AddSynthCommand(CLI::App& app, int&) { AddLeftOutCommand(app, "synth", kSynthSummary); }

int RenderElevations(const ElevationArguments&,
                     const CommonOptions&,
                     const TexturedModel&,
                     const fs::path&,
                     const fs::path&,
                     const std::vector<std::string>&) {
  throw LeftOut("render --elevation, --section and --developed");
}

int RenderMontage(const MontageArguments&,
                  const CommonOptions&,
                  const fs::path&,
                  const ModelOptions&,
                  const fs::path&) {
  throw LeftOut("render --over");
}

int EvaluateTrials(const EvaluateArguments&) { throw LeftOut("evaluate --trials"); }

int EvaluateScenes(const EvaluateArguments&) { throw LeftOut("evaluate of more than one FOUND"); }

void AddCameraFormatOption(CLI::App* command, std::string& format) {
  command->add_option(
      "--to", format, "write cameras as another program has them (not in this build)");
}

std::optional<ConvertResult> ConvertExchanged(const ConvertArguments& arguments) {
  if (!arguments.format.empty()) throw LeftOut("convert --to");
  if (IsForExchange(arguments.input) || EndsIn(arguments.output, ".city.json")) {
    throw LeftOut("convert " + arguments.input + " " + arguments.output +
                  " (cameras of other programs and of output folders, models of cities)");
  }
  return std::nullopt;
}

}  // namespace groundglass
