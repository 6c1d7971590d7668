// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/model_arguments.h"
#include "scene/advice/advice.h"
#include "scene/formats/scene_folder.h"

#include <string>
#include <vector>

namespace groundglass {

// What `check` has found.
struct CheckReport {
  SceneCheck check;
  std::vector<Advice> oddities;
  std::vector<std::string> overlays;  // written, by photograph

  size_t NumWarnings() const { return check.scene.warnings.size() + oddities.size(); }
};

// The model's size and unit, where the cameras stand, then what is wrong, last the sum of it.
std::string FormatCheckReport(const CheckReport& report, const ModelArguments& arguments);
std::string FormatCheckReportJson(const CheckReport& report, const ModelArguments& arguments);

// The model in a line or two, for a summary: size, unit, tolerance.
std::string FormatModelSummary(const PolygonModel& model, const ModelArguments& arguments);

}  // namespace groundglass
