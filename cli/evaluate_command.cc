// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/model_arguments.h"
#include "cli/option_range.h"
#include "evaluate/calibration_plot.h"
#include "evaluate/error_plot.h"
#include "evaluate/evaluate.h"
#include "evaluate/trials.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/model_io.h"
#include "scene/formats/scene_folder.h"
#include "viewer/renderer.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct EvaluateArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  std::string found;
  std::string truth;
  std::string model;
  std::string plot_file;            // empty: none
  std::string calibration_file;     // the same, of trials
  std::vector<std::string> beside;  // JSON of other trials, for the calibration plot
  // Monte-Carlo trials of registration; 0: none. `found` is then the scene itself.
  int num_trials = 0;
  TrialOptions trials;
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

// "wiesner" of "scenes/wiesner/".
std::string SceneName(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder / ".").lexically_normal();
  return whole.parent_path().filename().string();
}

int EvaluateFound(const EvaluateArguments& arguments) {
  const Truth truth = ReadTruth(arguments.truth);
  const fs::path model_file =
      arguments.model.empty() ? FindModel(arguments.truth) : fs::path(arguments.model);
  if (arguments.model.empty()) {
    const auto others = DescribeOtherModels(model_file.parent_path(), model_file);
    if (others) std::fprintf(stderr, "groundglass: %s\n", others->c_str());
  }
  const ModelReading reading = ReadModel(model_file, arguments.model_arguments.Options());
  for (const std::string& warning : reading.warnings) {
    std::fprintf(stderr, "groundglass: %s\n", warning.c_str());
  }
  const PolygonModel& model = reading.model;
  EvaluateOptions options;
  options.render = [](const TexturedModel& textured, const Camera& camera) {
    RenderOptions render_options;
    render_options.supersampling = 2;
    // A silhouette's pixels then have the building's colour alone, as the oracle's do.
    render_options.background = Background::kTransparent;
    return Render(textured, camera, render_options);
  };
  const Evaluation evaluation = Evaluate(arguments.found, truth, model, options);
  if (!arguments.plot_file.empty()) {
    WriteFileAtomically(
        arguments.plot_file,
        FormatErrorPlot(
            PlotPointsOf(evaluation), "Errors of " + arguments.found, UnitName(model.unit)));
  }
  std::fputs(arguments.common.json ? FormatEvaluationJson(evaluation, model).c_str()
                                   : FormatEvaluationTable(evaluation, model).c_str(),
             stdout);
  return kExitDone;
}

int RunTrialsOfScene(const EvaluateArguments& arguments) {
  SceneOptions scene_options;
  if (!arguments.model.empty()) scene_options.model_file = arguments.model;
  scene_options.model = arguments.model_arguments.Options();
  TrialOptions options = arguments.trials;
  options.num_trials = arguments.num_trials;
  options.seed = arguments.common.seed;
  options.Check();
  const Scene scene = ReadScene(arguments.found, scene_options);
  const std::vector<Trial> trials = RunTrials(
      scene, ReadTruth(arguments.truth), options, MakeProgress(arguments.common, "notebooks"));
  if (!arguments.plot_file.empty()) {
    WriteFileAtomically(arguments.plot_file,
                        FormatErrorPlot(PlotPointsOf(trials),
                                        "Trials of " + arguments.found + ", px at 640 wide",
                                        UnitName(scene.model.unit)));
  }
  if (!arguments.calibration_file.empty()) {
    std::vector<CalibrationCurve> curves = {CalibrationCurveOf(SceneName(arguments.found), trials)};
    for (const std::string& file : arguments.beside) {
      curves.push_back(ReadCalibrationCurve(fs::path(file).stem().string(), file));
    }
    WriteFileAtomically(arguments.calibration_file, FormatCalibrationPlot(curves));
  }
  std::fputs(arguments.common.json ? FormatTrialsJson(trials, options).c_str()
                                   : FormatTrialsTable(trials, options).c_str(),
             stdout);
  return kExitDone;
}

// Without having looked at any of it.
int TellEvaluation(const EvaluateArguments& arguments) {
  std::vector<std::string> files;
  for (const std::string& file : {arguments.plot_file, arguments.calibration_file}) {
    if (!file.empty()) files.push_back(file);
  }
  std::string words = "evaluate " + arguments.found + " against " + arguments.truth;
  for (const std::string& file : files) words += " and write " + file;
  return TellDryRun(arguments.common,
                    words,
                    {{"found", arguments.found}, {"truth", arguments.truth}, {"files", files}});
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
  command->add_option("--plot", arguments->plot_file, "SVG of errors against start and claims");
  AddModelOptions(command, arguments->model_arguments);
  AddCommonOptions(command, arguments->common);
  AddExample(command, "groundglass evaluate hall-out --truth hall/truth");
  CLI::Option* trials = command->add_option(
      "--trials",
      arguments->num_trials,
      "register FOUND, a scene folder, from this many notebooks drawn by chance");
  trials->check(AtLeast(0));
  command
      ->add_option("--sigma-position",
                   arguments->trials.sigma_position,
                   "of the trials' notebooks, across, model's unit")
      ->capture_default_str();
  command
      ->add_option("--sigma-height",
                   arguments->trials.sigma_height,
                   "of the trials' notebooks, up, model's unit")
      ->capture_default_str();
  command
      ->add_option("--sigma-lookat",
                   arguments->trials.sigma_lookat,
                   "of the trials' notebooks, look-at point, model's unit")
      ->capture_default_str();
  command->add_option("--blunders",
                      arguments->trials.num_blunders,
                      "tags of each trial's notebook that hold a blunder: swapped coordinates, a "
                      "wrong sign, another photograph's numbers");
  CLI::Option* calibration =
      command
          ->add_option("--calibration",
                       arguments->calibration_file,
                       "SVG of how many truths the trials' ellipsoids hold, by claimed confidence")
          ->needs(trials);
  command
      ->add_option("--beside",
                   arguments->beside,
                   "JSON that other trials have printed: more curves for --calibration")
      ->delimiter(',')
      ->needs(calibration);
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] {
      if (arguments->common.dry_run) return TellEvaluation(*arguments);
      return arguments->num_trials > 0 ? RunTrialsOfScene(*arguments) : EvaluateFound(*arguments);
    });
  });
}

}  // namespace groundglass
