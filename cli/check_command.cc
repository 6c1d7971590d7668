// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "scene/feature_edges.h"
#include "scene/image_io.h"
#include "scene/scene_folder.h"
#include "scene/visibility.h"
#include "viewer/overlay.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace groundglass {
namespace {

struct CheckArguments {
  CommonOptions common;
  std::string scene;
  std::string model;
  std::string output;
};

// The measured tags' view of the model over each photograph that could be read.
int DrawMeasuredTags(const Scene& scene, const CheckArguments& arguments) {
  const std::vector<ModelEdge> edges = FindModelEdges(scene.model);
  const Visibility visibility(scene.model);
  const Progress progress = MakeProgress(arguments.common, "overlay");
  int done = 0;
  for (const Photograph& photograph : scene.photographs) {
    const Camera measured =
        CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height);
    const Image8 overlay = DrawOverlay(
        ReadSrgb8(photograph.image_file), scene.model, edges, visibility, measured, nullptr);
    WriteSrgb8(std::filesystem::path(arguments.output) / (photograph.name + ".jpg"), overlay);
    ++done;
    if (progress) progress(done, static_cast<int>(scene.photographs.size()), photograph.name);
  }
  return done;
}

void PrintForPeople(const SceneCheck& check) {
  for (const std::string& fault : check.faults) std::printf("fault: %s\n", fault.c_str());
  for (const std::string& warning : check.scene.warnings) {
    std::printf("warning: %s\n", warning.c_str());
  }
  std::printf("%zu photographs with tags, %zu points, %zu faces; %zu faults, %zu warnings\n",
              check.scene.photographs.size(),
              check.scene.model.points_in_world.size(),
              check.scene.model.faces.size(),
              check.faults.size(),
              check.scene.warnings.size());
}

void PrintJson(const SceneCheck& check) {
  nlohmann::ordered_json json;
  json["faults"] = check.faults;
  json["warnings"] = check.scene.warnings;
  json["points"] = check.scene.model.points_in_world.size();
  json["faces"] = check.scene.model.faces.size();
  json["photographs"] = nlohmann::ordered_json::array();
  for (const Photograph& photograph : check.scene.photographs) {
    json["photographs"].push_back({{"name", photograph.name},
                                   {"image", photograph.image_file.string()},
                                   {"width_px", photograph.size.width},
                                   {"height_px", photograph.size.height}});
  }
  std::printf("%s\n",
              json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

int RunCheck(const CheckArguments& arguments) {
  SceneOptions options;
  if (!arguments.model.empty()) options.model_file = arguments.model;
  options.model.unit = arguments.common.unit;
  const SceneCheck check = CheckScene(arguments.scene, options);
  if (arguments.common.json) {
    PrintJson(check);
  } else {
    PrintForPeople(check);
  }
  // Overlays show best where a tag is off, but only a sound scene can be drawn as a whole.
  if (!arguments.output.empty() && !arguments.common.dry_run && check.faults.empty()) {
    const int drawn = DrawMeasuredTags(check.scene, arguments);
    std::fprintf(stderr, "%d overlays in %s\n", drawn, arguments.output.c_str());
  }
  return check.faults.empty() ? kExitDone : kExitWrongInput;
}

}  // namespace

void AddCheckCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Read everything of a scene and tell all that is wrong with it, in one go");
  command->add_option("scene", arguments->scene, "the scene folder")->required();
  command->add_option("--model", arguments->model, "this model in place of the folder's");
  command->add_option(
      "-o,--out", arguments->output, "draw the measured tags over the photographs into here");
  AddCommonOptions(command, arguments->common);
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [arguments] { return RunCheck(*arguments); });
  });
}

}  // namespace groundglass
