// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/scene_summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace groundglass {
namespace {

std::optional<double> MedianOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// All photographs together, as the last line.
JudgedScene AllTogether(const std::vector<JudgedScene>& scenes) {
  JudgedScene all;
  all.name = "all";
  for (const JudgedScene& scene : scenes) {
    all.photographs.insert(
        all.photographs.end(), scene.photographs.begin(), scene.photographs.end());
  }
  return all;
}

std::string TwoDecimals(const std::optional<double>& px) {
  return px ? fmt::format("{:.2f}", *px) : "-";
}

nlohmann::ordered_json NumberOrNull(const std::optional<double>& px) {
  return px ? nlohmann::ordered_json(*px) : nlohmann::ordered_json(nullptr);
}

std::string FormatLine(const SceneSummary& summary, int name_width) {
  const std::string share =
      summary.num_calibrated > 0
          ? fmt::format("{} of {}", summary.num_inside_95, summary.num_calibrated)
          : "-";
  return fmt::format("{:<{}} {:6} {:9} {:7} {:9} {:6} {:>9} {:>10} {:>9} {:>12}\n",
                     summary.name,
                     name_width,
                     summary.count,
                     summary.num_accepted,
                     summary.num_review,
                     summary.num_rejected,
                     summary.num_wrong_accepted,
                     TwoDecimals(summary.median_start_px),
                     TwoDecimals(summary.median_px),
                     TwoDecimals(summary.worst_px),
                     share);
}

nlohmann::ordered_json JsonFromSceneSummary(const SceneSummary& summary) {
  return {{"name", summary.name},
          {"count", summary.count},
          {"accepted", summary.num_accepted},
          {"review", summary.num_review},
          {"rejected", summary.num_rejected},
          {"wrong_accepted", summary.num_wrong_accepted},
          {"calibrated", summary.num_calibrated},
          {"inside_95", summary.num_inside_95},
          {"median_start_px_at_640", NumberOrNull(summary.median_start_px)},
          {"median_px_at_640", NumberOrNull(summary.median_px)},
          {"worst_px_at_640", NumberOrNull(summary.worst_px)}};
}

}  // namespace

JudgedScene JudgedSceneOf(const std::string& name,
                          const Evaluation& evaluation,
                          const Truth& truth) {
  std::map<std::string, int> width_of_name;
  for (const NamedCamera& camera : truth.cameras) {
    width_of_name[camera.name] = camera.camera.width_px;
  }
  JudgedScene scene;
  scene.name = name;
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    const double to_640 = 640.0 / width_of_name.at(photograph.name);
    JudgedPhotograph& judged = scene.photographs.emplace_back();
    judged.verdict = photograph.verdict;
    if (photograph.start_px) judged.start_px = to_640 * *photograph.start_px;
    judged.end_px = to_640 * photograph.errors.vertex.mean_px;
    judged.is_wrong_accepted = photograph.is_wrong_accepted;
    if (photograph.verdict == Verdict::kAccepted && photograph.calibration) {
      judged.is_inside_95 = photograph.calibration->is_inside_95;
    }
  }
  return scene;
}

JudgedScene JudgedSceneOf(const std::string& name, const std::vector<Trial>& trials) {
  JudgedScene scene;
  scene.name = name;
  for (const Trial& trial : trials) {
    if (trial.blunder != Blunder::kNone) continue;
    JudgedPhotograph& judged = scene.photographs.emplace_back();
    judged.verdict = trial.verdict;
    judged.start_px = trial.start_at_640_px;
    judged.end_px = trial.end_at_640_px;
    judged.is_wrong_accepted = trial.is_wrong_accepted;
    if (trial.confidence) judged.is_inside_95 = trial.IsInside95();
  }
  return scene;
}

SceneSummary SummariseScene(const JudgedScene& scene) {
  SceneSummary summary;
  summary.name = scene.name;
  summary.count = static_cast<int>(scene.photographs.size());
  std::vector<double> starts;
  std::vector<double> ends;
  for (const JudgedPhotograph& photograph : scene.photographs) {
    summary.num_accepted += photograph.verdict == Verdict::kAccepted;
    summary.num_review += photograph.verdict == Verdict::kReview;
    summary.num_rejected += photograph.verdict == Verdict::kRejected;
    summary.num_wrong_accepted += photograph.is_wrong_accepted;
    summary.num_calibrated += photograph.is_inside_95.has_value();
    summary.num_inside_95 += photograph.is_inside_95.value_or(false);
    if (photograph.start_px) starts.push_back(*photograph.start_px);
    if (photograph.verdict.value_or(Verdict::kAccepted) == Verdict::kAccepted) {
      ends.push_back(photograph.end_px);
    }
  }
  summary.median_start_px = MedianOf(starts);
  summary.median_px = MedianOf(ends);
  if (!ends.empty()) summary.worst_px = *std::max_element(ends.begin(), ends.end());
  return summary;
}

std::string FormatScenesTable(const std::vector<JudgedScene>& scenes) {
  int name_width = 5;
  for (const JudgedScene& scene : scenes) {
    name_width = std::clamp(static_cast<int>(scene.name.size()), name_width, 60);
  }
  std::string text = fmt::format("{:<{}} {:>6} {:>9} {:>7} {:>9} {:>6} {:>9} {:>10} {:>9} {:>12}\n",
                                 "scene",
                                 name_width,
                                 "tags",
                                 "accepted",
                                 "review",
                                 "rejected",
                                 "wrong",
                                 "start px",
                                 "median px",
                                 "worst px",
                                 "in 95 %");
  for (const JudgedScene& scene : scenes) text += FormatLine(SummariseScene(scene), name_width);
  text += FormatLine(SummariseScene(AllTogether(scenes)), name_width);
  return text +
         "pixels at 640 wide; start: median of the tags; median and worst of what is accepted\n";
}

std::string FormatScenesJson(const std::vector<JudgedScene>& scenes) {
  nlohmann::ordered_json json = {{"scenes", nlohmann::ordered_json::array()}};
  for (const JudgedScene& scene : scenes) {
    json["scenes"].push_back(JsonFromSceneSummary(SummariseScene(scene)));
  }
  json["all"] = JsonFromSceneSummary(SummariseScene(AllTogether(scenes)));
  return json.dump(2) + "\n";
}

}  // namespace groundglass
