// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_input.h"

#include "scene/error.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr size_t kManyPhotographs = 40;

std::optional<nlohmann::json> ReadJsonIfThere(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return nlohmann::json::parse(ReadTextFile(file));
  } catch (const nlohmann::json::exception& error) {
    throw Error(file, std::string("is not JSON: ") + error.what());
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
  if (input.registrations && input.registrations->size() > kManyPhotographs) {
    input.options.picture_width_px = std::max(1, options.picture_width_px / 2);
  }
  return input;
}

}  // namespace groundglass
