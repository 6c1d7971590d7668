// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "cli/convert_arguments.h"
#include "cli/json_output.h"
#include "cli/option_range.h"
#include "cli/warnings_last.h"
#include "scene/error.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/convert.h"
#include "scene/formats/input_folders.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string_view>

namespace groundglass {
namespace {

bool IsModelFile(const std::string& file) {
  constexpr std::string_view kEndings[] = {".osu", ".obj", ".glb", ".city.json"};
  return std::any_of(std::begin(kEndings), std::end(kEndings), [&](std::string_view ending) {
    return EndsIn(file, ending);
  });
}

// Whoever names a model's file wants a model, and a folder is none.
void RefuseFolderOfModel(const std::filesystem::path& input, const std::string& output) {
  if (!std::filesystem::is_directory(input) || !IsModelFile(output)) return;
  std::string which = "give the model's own file";
  if (std::filesystem::is_regular_file(input / "model.glb")) {
    which = "give " + (input / "model.glb").string();
  }
  throw Error(input, "is a folder, and what becomes a model is a model's file; " + which);
}

ConvertResult Convert(const ConvertArguments& arguments) {
  const std::filesystem::path input = arguments.input;
  if (arguments.format.empty()) RefuseFolderOfModel(input, arguments.output);
  if (const auto exchanged = ConvertExchanged(arguments)) return *exchanged;
  if (std::filesystem::is_directory(input)) {
    if (FindColmapModel(input)) {
      return ConvertColmapToViews(input, arguments.output, arguments.lookat_distance);
    }
    return ConvertViewsToColmap(input, arguments.output, arguments.images);
  }
  return ConvertModel(
      input, arguments.output, arguments.model_arguments.Options(), arguments.output_unit);
}

int RunConvert(const ConvertArguments& arguments) {
  RefuseFilledInputs(arguments.output);
  if (arguments.common.dry_run) {
    return TellDryRun(arguments.common,
                      "convert " + arguments.input + " to " + arguments.output,
                      {{"input", arguments.input}, {"output", arguments.output}});
  }
  const ConvertResult result = Convert(arguments);
  for (const std::string& warning : result.warnings) {
    std::fprintf(stderr, "groundglass: warning: %s\n", warning.c_str());
  }
  if (arguments.common.json) {
    PrintJson({{"output", arguments.output},
               {"summary", result.summary},
               {"faces_left_out", result.faces_left_out},
               {"warnings", result.warnings}});
  } else {
    std::printf("%s%s\n",
                result.summary.c_str(),
                result.warnings.empty()
                    ? ""
                    : ("; " + CountWarnings(result.warnings.size()) + ", see above").c_str());
  }
  return kExitDone;
}

}  // namespace

void AddConvertCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert",
      "Convert between formats: a model (.osu .obj .ply .stl .gml .gltf .glb to .osu .obj .glb\n"
      ".city.json), or cameras (an output folder, a COLMAP model, a folder of .view files, or "
      "another\n"
      "program's file to .view files, or with --to to another program's; view files to COLMAP's)");
  command->add_option("input", arguments->input, "a model, or cameras: a folder or a file")
      ->required();
  command->add_option("output", arguments->output, "a model, or a folder or file for cameras")
      ->required();
  command->add_option_function<std::string>(
      "--to-unit",
      [raw = arguments.get()](const std::string& unit) {
        raw->output_unit = FindUnit(unit);
        if (!raw->output_unit) {
          throw CLI::ValidationError("--to-unit", unit + " is not one of " + UnitNames());
        }
      },
      "write the model's lengths in this unit: " + UnitNames());
  AddCameraFormatOption(command, arguments->format);
  command->add_option(
      "--images", arguments->images, "the photographs (of view files by default: ../images)");
  command
      ->add_option("--lookat-distance",
                   arguments->lookat_distance,
                   "how far ahead of a COLMAP camera its look-at point is put, model's unit")
      ->check(Above(0))
      ->capture_default_str();
  AddModelOptions(command, arguments->model_arguments);
  AddCommonOptions(command, arguments->common);
  AddExample(command,
             "groundglass convert hall.obj hall/model.osu --up y --unit m\n"
             "  groundglass convert hall-out hall.mlp --to meshlab --images hall/images");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [arguments] { return RunConvert(*arguments); });
  });
}

}  // namespace groundglass
