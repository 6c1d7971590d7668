// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/evaluate_arguments.h"
#include "cli/json_output.h"
#include "evaluate/calibration_plot.h"
#include "evaluate/error_plot.h"
#include "evaluate/evaluate.h"
#include "evaluate/scene_summary.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/scene_folder.h"

#include <cstdio>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// "wiesner" of "scenes/wiesner/".
std::string SceneName(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder / ".").lexically_normal();
  return whole.parent_path().filename().string();
}

TrialOptions TrialOptionsOf(const EvaluateArguments& arguments) {
  TrialOptions options = arguments.trials;
  options.num_trials = arguments.num_trials;
  options.seed = arguments.common.seed;
  options.Check();
  return options;
}

Scene ReadTrialScene(const EvaluateArguments& arguments, size_t index) {
  SceneOptions options;
  if (!arguments.model.empty()) options.model_file = arguments.model;
  options.model = arguments.model_arguments.Options();
  return ReadScene(arguments.found[index], options);
}

void WriteCalibration(const EvaluateArguments& arguments,
                      const std::string& name,
                      const std::vector<Trial>& trials) {
  std::vector<CalibrationCurve> curves = {CalibrationCurveOf(name, trials)};
  for (const std::string& file : arguments.beside) {
    curves.push_back(ReadCalibrationCurve(fs::path(file).stem().string(), file));
  }
  WriteFileAtomically(arguments.calibration_file, FormatCalibrationPlot(curves));
}

}  // namespace

int EvaluateTrials(const EvaluateArguments& arguments) {
  const TrialOptions options = TrialOptionsOf(arguments);
  const std::string& found = arguments.found.front();
  const Scene scene = ReadTrialScene(arguments, 0);
  const std::vector<Trial> trials = RunTrials(scene,
                                              ReadTruth(TruthFolder(arguments, 0)),
                                              options,
                                              MakeProgress(arguments.common, "notebooks"));
  if (!arguments.plot_file.empty()) {
    WriteFileAtomically(arguments.plot_file,
                        FormatErrorPlot(PlotPointsOf(trials),
                                        "Trials of " + found + ", px at 640 wide",
                                        UnitName(scene.model.unit)));
  }
  if (!arguments.calibration_file.empty()) WriteCalibration(arguments, SceneName(found), trials);
  std::fputs(arguments.common.json ? FormatTrialsJson(trials, options).c_str()
                                   : FormatTrialsTable(trials, options).c_str(),
             stdout);
  return kExitDone;
}

int EvaluateScenes(const EvaluateArguments& arguments) {
  std::vector<JudgedScene> scenes;
  std::vector<Trial> all_trials;
  for (size_t i = 0; i < arguments.found.size(); ++i) {
    const std::string& found = arguments.found[i];
    const Truth truth = ReadTruth(TruthFolder(arguments, i));
    if (arguments.num_trials > 0) {
      const std::vector<Trial> trials =
          RunTrials(ReadTrialScene(arguments, i),
                    truth,
                    TrialOptionsOf(arguments),
                    MakeProgress(arguments.common, found + ": notebooks"));
      scenes.push_back(JudgedSceneOf(found, trials));
      all_trials.insert(all_trials.end(), trials.begin(), trials.end());
    } else {
      const PolygonModel model = ReadModelOf(arguments, truth.folder);
      scenes.push_back(JudgedSceneOf(found, Evaluate(found, truth, model), truth));
    }
  }
  if (!arguments.calibration_file.empty()) {
    WriteCalibration(arguments, std::to_string(arguments.found.size()) + " scenes", all_trials);
  }
  std::fputs((arguments.common.json ? FormatScenesJson(scenes) : FormatScenesTable(scenes)).c_str(),
             stdout);
  return kExitDone;
}

}  // namespace groundglass
