// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "datasets-synthetic/evaluate.h"
#include "scene/error.h"
#include "scene/model_io.h"
#include "viewer/renderer.h"

#include <cstdio>
#include <memory>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct EvaluateArguments {
  CommonOptions common;
  std::string found;
  std::string truth;
  std::string model;
};

// The model beside the truth folder, as in every scene.
fs::path FindModel(const fs::path& truth_folder) {
  const fs::path scene_folder =
      fs::absolute(truth_folder / ".").lexically_normal().parent_path().parent_path();
  for (const char* extension : {".osu", ".obj", ".ply", ".glb"}) {
    const fs::path file = scene_folder / (std::string("model") + extension);
    if (fs::exists(file)) return file;
  }
  throw Error(scene_folder, "no model beside the truth folder; name it with --model");
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate", "Errors of cameras, masks and textures against a scene's known truth");
  command
      ->add_option(
          "found", arguments->found, "output folder, folder of .view files, or COLMAP text model")
      ->required();
  command->add_option("--truth", arguments->truth, "the scene's truth folder")->required();
  command->add_option("--model", arguments->model, "the polygon model, if not beside the truth");
  AddCommonOptions(command, arguments->common);
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] {
      const Truth truth = ReadTruth(arguments->truth);
      ModelOptions model_options;
      model_options.unit = arguments->common.unit;
      const PolygonModel model = ReadModel(arguments->model.empty() ? FindModel(arguments->truth)
                                                                    : fs::path(arguments->model),
                                           model_options)
                                     .model;
      EvaluateOptions options;
      options.render = [](const TexturedModel& textured, const Camera& camera) {
        RenderOptions render_options;
        render_options.supersampling = 2;
        return Render(textured, camera, render_options);
      };
      const Evaluation evaluation = Evaluate(arguments->found, truth, model, options);
      std::fputs(arguments->common.json ? FormatEvaluationJson(evaluation, model).c_str()
                                        : FormatEvaluationTable(evaluation, model).c_str(),
                 stdout);
      return kExitDone;
    });
  });
}

}  // namespace groundglass
