// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "report/report.h"
#include "scene/registration.h"
#include "scene/tie_use.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What a report is made of: an output folder as read, and the scene if there is one.
struct ReportInput {
  std::filesystem::path folder;
  const Scene* scene = nullptr;
  ReportOptions options;  // with a title
  // What one photograph, and one picture from a new viewpoint, may weigh.
  size_t photograph_bytes = 0;
  size_t still_bytes = 0;
  std::string unit;  // of lengths, as it is written behind a number: " ft"
  std::optional<std::vector<Registration>> registrations;
  std::vector<ModelError> model_errors;
  TieUse ties;
  std::optional<nlohmann::json> coverage;
  std::optional<nlohmann::json> manifest;
};

// Error if a file is damaged, or if there is neither registration.json nor coverage.json.
ReportInput ReadReportInput(const std::filesystem::path& folder,
                            const Scene* scene,
                            const ReportOptions& options);

}  // namespace groundglass
