// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "scene/colmap_io.h"
#include "scene/convert.h"
#include "scene/error.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>

namespace groundglass {
namespace {

struct ConvertArguments {
  CommonOptions common;
  std::string input;
  std::string output;
  std::string frame = "world";
  std::string up = "z";
  std::string images;
  double lookat_distance = 100;
};

ConvertResult Convert(const ConvertArguments& arguments) {
  const std::filesystem::path input = arguments.input;
  if (std::filesystem::is_directory(input)) {
    if (FindColmapModel(input)) {
      return ConvertColmapToViews(input, arguments.output, arguments.lookat_distance);
    }
    const std::filesystem::path images =
        arguments.images.empty() ? input / "../images" : std::filesystem::path(arguments.images);
    return ConvertViewsToColmap(input, arguments.output, images);
  }
  ModelOptions options;
  options.unit = arguments.common.unit;
  if (arguments.frame == "site") options.mesh_axes = MeshAxes::kSite;
  if (arguments.up == "y") options.mesh_axes = MeshAxes::kYUp;
  return ConvertModel(input, arguments.output, options);
}

int RunConvert(const ConvertArguments& arguments) {
  if (arguments.frame == "site" && arguments.up == "y") {
    throw Error("--frame site has z up; it cannot go with --up y");
  }
  if (arguments.common.dry_run) {
    std::printf("would convert %s to %s\n", arguments.input.c_str(), arguments.output.c_str());
    return kExitDone;
  }
  const ConvertResult result = Convert(arguments);
  for (const std::string& warning : result.warnings) {
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  }
  if (arguments.common.json) {
    const nlohmann::ordered_json json = {
        {"output", arguments.output}, {"summary", result.summary}, {"warnings", result.warnings}};
    std::printf("%s\n",
                json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  } else {
    std::printf("%s\n", result.summary.c_str());
  }
  return kExitDone;
}

}  // namespace

void AddConvertCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert",
      "Convert between formats: a model (.osu .obj .ply .stl .gltf .glb to .osu .obj .glb), or\n"
      "cameras (a COLMAP model, text or binary, to a folder of .view files, and back)");
  command->add_option("input", arguments->input, "a model, or a folder of cameras")->required();
  command->add_option("output", arguments->output, "a model, or a folder for cameras")->required();
  command->add_option("--frame", arguments->frame, "axes of an OBJ, PLY or STL file")
      ->check(CLI::IsMember({"world", "site"}))
      ->capture_default_str();
  command->add_option("--up", arguments->up, "the axis that is up in an OBJ, PLY or STL file")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  command->add_option(
      "--images", arguments->images, "the photographs of the view files (default: ../images)");
  command
      ->add_option("--lookat-distance",
                   arguments->lookat_distance,
                   "how far ahead of a COLMAP camera its look-at point is put, model's unit")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  AddCommonOptions(command, arguments->common);
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [arguments] { return RunConvert(*arguments); });
  });
}

}  // namespace groundglass
