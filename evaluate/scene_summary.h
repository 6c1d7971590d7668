// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "evaluate/evaluate.h"
#include "evaluate/trials.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph of many scenes, for a table: vertex errors in proportion at 640 px wide.
struct JudgedPhotograph {
  std::optional<Verdict> verdict;  // nothing: no registration.json says one
  std::optional<double> start_px;  // of the tag
  double end_px = 0;
  bool is_wrong_accepted = false;
  // Whether the truth lies in the claimed covariance's 95 % ellipsoid; of accepted photographs
  // alone, since only they claim that it holds.
  std::optional<bool> is_inside_95;
};

struct JudgedScene {
  std::string name;
  std::vector<JudgedPhotograph> photographs;
};
// Photographs that nothing was found of are left out.
JudgedScene JudgedSceneOf(const std::string& name,
                          const Evaluation& evaluation,
                          const Truth& truth);
// Blunders are left out: their errors were not drawn from the sigmas that their tags state.
JudgedScene JudgedSceneOf(const std::string& name, const std::vector<Trial>& trials);

// A line of the table.
struct SceneSummary {
  std::string name;
  int count = 0;
  int num_accepted = 0;
  int num_review = 0;
  int num_rejected = 0;
  int num_wrong_accepted = 0;
  int num_calibrated = 0;
  int num_inside_95 = 0;
  std::optional<double> median_start_px;  // of all that have one
  // Of the accepted photographs; of all where there are no verdicts. Nothing if there are none.
  std::optional<double> median_px;
  std::optional<double> worst_px;
};
SceneSummary SummariseScene(const JudgedScene& scene);

// A line for each scene, and one for all together: for people, and for programs.
std::string FormatScenesTable(const std::vector<JudgedScene>& scenes);
std::string FormatScenesJson(const std::vector<JudgedScene>& scenes);

}  // namespace groundglass
