// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/registration_output.h"

#include "scene/formats/atomic_file.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"

namespace groundglass {

void WriteRegistrationOutput(const Scene& scene,
                             const RegisteredScene& registered,
                             const std::filesystem::path& out) {
  const std::vector<Registration>& registrations = registered.registrations;
  std::vector<NamedCamera> cameras;
  for (size_t i = 0; i < registrations.size(); ++i) {
    const Registration& registration = registrations[i];
    if (registration.verdict == Verdict::kUnreadable) continue;
    const Photograph& photograph = scene.photographs[i];
    const std::string measured_text = photograph.view_file.empty()
                                          ? FormatView(registration.measured)
                                          : ReadTextFile(photograph.view_file);
    const TagDeviations deviations = TagDeviationsFromCovariance(
        ParametersFromTag(registration.corrected), registration.covariance, registration.measured);
    WriteFileAtomically(
        out / "views" / (registration.name + ".view"),
        registration.verdict == Verdict::kRejected
            ? FormatCorrectedView(measured_text, registration.measured, {})
            : FormatCorrectedView(measured_text, registration.corrected, deviations));
    cameras.push_back({ImageName(scene, photograph), registration.CorrectedCamera()});
  }
  WriteColmapModel(out / "cameras", cameras);
  WriteFileAtomically(
      out / "registration.json",
      FormatRegistrations(
          registrations, registered.model_errors, registered.warnings, registered.ties));
}

}  // namespace groundglass
