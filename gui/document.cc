// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/document.h"

#include "session/alignment.h"
#include "session/journal.h"

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Whether the run was given this tag. Numbers that the tag leaves to a lens file may differ.
bool IsTagOf(const ViewTag& written, const Registration& registration, bool has_lens) {
  const CameraParameters by = ParametersFromTag(written) - ParametersFromTag(registration.measured);
  const int num_compared = has_lens ? kViewAngle : kNumCameraParameters;
  return by.head(num_compared).cwiseAbs().maxCoeff() < 1e-6;
}

}  // namespace

Document OpenDocument(const WindowOptions& options) {
  const fs::path& folder = options.folder;
  Document document;
  document.title = folder.filename().empty() ? folder.parent_path().filename().string()
                                             : folder.filename().string();
  document.opened = OpenFolder(folder, options.scene_folder, options.model, true);
  if (!document.opened.scene.folder.empty()) {
    document.journal_file = Journal::PlaceFor(document.opened.scene.folder);
  }
  for (const Registration& registration : document.opened.registrations) {
    document.registrations[registration.name] = registration;
  }
  return document;
}

void StartFromTheRun(const Document& document, Session& session) {
  for (const Registration& registration : document.opened.registrations) {
    const auto photograph = session.FindPhotograph(registration.name);
    if (!photograph || !HasCorrection(registration.verdict)) continue;
    const auto& written = session.work(*photograph).tag;
    const SessionPhotograph& of = session.photographs()[*photograph];
    const bool is_as_large =
        of.size.width == registration.width_px && of.size.height == registration.height_px;
    if (!written || !is_as_large || !IsTagOf(*written, registration, of.lens.has_value())) continue;
    session.StartFrom(*photograph, NewsOf(registration));
  }
}

}  // namespace groundglass
