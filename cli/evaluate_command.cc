// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "cli/evaluate_arguments.h"
#include "cli/json_output.h"
#include "cli/option_range.h"
#include "evaluate/error_plot.h"
#include "evaluate/evaluate.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/model_io.h"
#include "viewer/renderer.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// The model beside the truth folder, as in every scene.
fs::path FindModel(const fs::path& truth_folder) {
  const fs::path scene_folder =
      fs::absolute(truth_folder / ".").lexically_normal().parent_path().parent_path();
  for (const char* extension : {".osu", ".obj", ".ply", ".glb"}) {
    fs::path file = scene_folder / (std::string("model") + extension);
    if (fs::exists(file)) return file;
  }
  throw Error(scene_folder, "no model beside the truth folder; name it with --model");
}

int EvaluateFound(const EvaluateArguments& arguments) {
  const Truth truth = ReadTruth(TruthFolder(arguments, 0));
  const PolygonModel model = ReadModelOf(arguments, truth.folder);
  EvaluateOptions options;
  options.render = [](const TexturedModel& textured, const Camera& camera) {
    RenderOptions render_options;
    render_options.supersampling = 2;
    // A silhouette's pixels then have the building's colour alone, as the oracle's do.
    render_options.background = Background::kTransparent;
    return Render(textured, camera, render_options);
  };
  const Evaluation evaluation = Evaluate(arguments.found.front(), truth, model, options);
  if (!arguments.plot_file.empty()) {
    WriteFileAtomically(arguments.plot_file,
                        FormatErrorPlot(PlotPointsOf(evaluation),
                                        "Errors of " + arguments.found.front(),
                                        UnitName(model.unit)));
  }
  std::fputs(arguments.common.json ? FormatEvaluationJson(evaluation, model).c_str()
                                   : FormatEvaluationTable(evaluation, model).c_str(),
             stdout);
  return kExitDone;
}

// Several scenes are judged by their cameras alone, each by its own model and truth.
void CheckSeveral(const EvaluateArguments& arguments) {
  if (!arguments.truths.empty() && arguments.truths.size() != arguments.found.size()) {
    throw CLI::ValidationError("--truth",
                               "one for each FOUND is expected, or none where it lies in or beside "
                               "what was found; there are " +
                                   std::to_string(arguments.truths.size()) + " for " +
                                   std::to_string(arguments.found.size()));
  }
  if (arguments.found.size() < 2) return;
  if (!arguments.plot_file.empty()) {
    throw CLI::ValidationError("--plot", "draws one scene; give one FOUND");
  }
  if (!arguments.model.empty()) {
    throw CLI::ValidationError("--model", "is one scene's; give one FOUND");
  }
}

// Without having looked at any of it.
int TellEvaluation(const EvaluateArguments& arguments) {
  std::vector<std::string> files;
  for (const std::string& file : {arguments.plot_file, arguments.calibration_file}) {
    if (!file.empty()) files.push_back(file);
  }
  std::string words = "evaluate ";
  for (const std::string& found : arguments.found) {
    words += (&found == &arguments.found.front() ? "" : ", ") + found;
  }
  if (!arguments.truths.empty()) words += " against ";
  for (const std::string& truth : arguments.truths) {
    words += (&truth == &arguments.truths.front() ? "" : ", ") + truth;
  }
  for (const std::string& file : files) words += " and write " + file;
  return TellDryRun(arguments.common,
                    words,
                    {{"found", arguments.found}, {"truth", arguments.truths}, {"files", files}});
}

}  // namespace

fs::path TruthFolder(const EvaluateArguments& arguments, size_t index) {
  if (!arguments.truths.empty()) return arguments.truths[index];
  const fs::path found = fs::absolute(fs::path(arguments.found[index]) / ".").lexically_normal();
  for (const fs::path& folder : {found.parent_path(), found.parent_path().parent_path()}) {
    if (fs::is_directory(folder / "truth")) return folder / "truth";
  }
  throw Error(arguments.found[index], "no truth folder in it or beside it; name it with --truth");
}

PolygonModel ReadModelOf(const EvaluateArguments& arguments, const fs::path& truth_folder) {
  const fs::path model_file =
      arguments.model.empty() ? FindModel(truth_folder) : fs::path(arguments.model);
  if (arguments.model.empty()) {
    const auto others = DescribeOtherModels(model_file.parent_path(), model_file);
    if (others) std::fprintf(stderr, "groundglass: %s\n", others->c_str());
  }
  const ModelReading reading = ReadModel(model_file, arguments.model_arguments.Options());
  for (const std::string& warning : reading.warnings) {
    std::fprintf(stderr, "groundglass: %s\n", warning.c_str());
  }
  return reading.model;
}

void AddEvaluateCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate", "Errors of cameras, masks and textures against a scene's known truth");
  command
      ->add_option(
          "found",
          arguments->found,
          "output folder, folder of .view files, or COLMAP text model; several give one table")
      ->required();
  command
      ->add_option("--truth",
                   arguments->truths,
                   "the scene's truth folder; where there is none: truth/ in FOUND or beside it")
      ->delimiter(',')
      ->allow_extra_args(false);
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
  command
      ->add_option("--overclaim",
                   arguments->trials.overclaim,
                   "how many times smaller than these the sigmas are that the trials' tags state")
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
    CheckSeveral(*arguments);
    exit_status = RunWithThreads(arguments->common, [&] {
      if (arguments->common.dry_run) return TellEvaluation(*arguments);
      if (arguments->found.size() > 1) return EvaluateScenes(*arguments);
      return arguments->num_trials > 0 ? EvaluateTrials(*arguments) : EvaluateFound(*arguments);
    });
  });
}

}  // namespace groundglass
