// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/formats.h"
#include "scene/error.h"
#include "scene/formats/csv.h"
#include "scene/text.h"

namespace groundglass {
namespace {

std::string CorrectionRow(const Registration& registration) {
  std::string row =
      CsvField(registration.name) + "," + std::string(VerdictName(registration.verdict));
  if (registration.verdict == Verdict::kUnreadable) {
    return row + std::string(3 * kNumCameraParameters + 1, ',');
  }
  const CameraParameters measured = SiteParameters(ParametersFromTag(registration.measured));
  const CameraParameters corrected = SiteParameters(ParametersFromTag(registration.corrected));
  for (int i = 0; i < kNumCameraParameters; ++i) {
    row += "," + FormatNumber(measured[i]) + "," + FormatNumber(corrected[i]) + "," +
           FormatNumber(registration.sigmas[i]);
  }
  return row + "," + FormatNumber(registration.moved_px);
}

}  // namespace

std::vector<FileToWrite> FormatCorrections(const ExchangeScene& scene,
                                           const std::filesystem::path& out) {
  if (scene.registrations.empty()) {
    throw Error(out, "a table of corrections needs an output folder with registration.json");
  }
  std::string text = "photograph,verdict";
  for (const std::string_view name : kCameraParameterNames) {
    const std::string key(name);
    text += "," + key + "_measured," + key + "_corrected," + key + "_sigma";
  }
  text += ",moved_px\n";
  for (const Registration& registration : scene.registrations) {
    text += CorrectionRow(registration) + "\n";
  }
  return {{out, text}};
}

}  // namespace groundglass
