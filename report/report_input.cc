// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_input.h"

#include "scene/error.h"
#include "scene/formats/json_fault.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Shares of the page's weight that pictures may take, as JPEG: Base64 adds a third.
constexpr double kPhotographsShare = 0.42;
constexpr double kStillsShare = 0.08;
constexpr size_t kUsualStills = 8;

std::optional<nlohmann::json> ReadJsonIfThere(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return nlohmann::json::parse(ReadTextFile(file));
  } catch (const nlohmann::json::exception& error) {
    throw Error(file, "is not JSON: " + TellJsonFault(error.what()));
  }
}

}  // namespace

ReportInput ReadReportInput(const fs::path& folder,
                            const Scene* scene,
                            const ReportOptions& options) {
  ReportInput input;
  input.folder = folder;
  input.scene = scene;
  input.options = options;
  input.unit = scene ? " " + UnitName(scene->model.unit) : " units";
  const fs::path registration_file = folder / "registration.json";
  if (fs::exists(registration_file)) {
    input.registrations = ReadRegistrations(registration_file);
    input.model_errors = ReadModelErrors(registration_file);
    input.ties = ReadTieUse(registration_file);
  }
  input.coverage = ReadJsonIfThere(folder / "coverage.json");
  input.manifest = ReadJsonIfThere(folder / "manifest.json");
  if (!input.registrations && !input.coverage) {
    throw Error(folder, "holds neither registration.json nor coverage.json: nothing to report");
  }
  if (options.title.empty()) {
    const fs::path named = scene ? scene->folder : folder;
    input.options.title = fs::weakly_canonical(named).filename().string();
  }
  const double max_bytes = 1e6 * options.max_megabytes;
  const size_t num_photographs = input.registrations ? input.registrations->size() : 0;
  input.photograph_bytes = static_cast<size_t>(
      kPhotographsShare * max_bytes / static_cast<double>(std::max<size_t>(1, num_photographs)));
  input.still_bytes = static_cast<size_t>(kStillsShare * max_bytes / kUsualStills);
  return input;
}

}  // namespace groundglass
