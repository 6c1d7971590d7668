// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"
#include "session/pins.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What registration said of a photograph when it was asked from here.
struct AlignmentNews {
  Verdict verdict = Verdict::kRejected;
  std::vector<std::string> reasons;
  ViewTag corrected;  // with its standard deviations
  double moved_px = 0;
  double vertex_sigma_px = 0;
  std::optional<double> rms_px;
  std::optional<double> margin_nats;
  std::vector<std::string> undetermined;
  std::optional<ViewTag> rival = {};  // of one in review: the camera that it may have instead

  bool operator==(const AlignmentNews&) const = default;
};

// All that a person decides about one photograph. A plain value: undo keeps copies of it.
struct PhotographWork {
  std::optional<ViewTag> tag;  // where the camera is sought, with its sigmas; nothing: nobody said
  Pins pins;
  std::optional<AlignmentNews> alignment;  // the last one, not yet taken
  std::optional<ViewTag> accepted;         // the camera that was taken, from there or by a person
  // Why, where it was taken against the verdict; the view file keeps it.
  std::string overruled;

  bool operator==(const PhotographWork&) const = default;
};

// One line of JSON, and back; numbers to the last bit. The second throws Error.
std::string FormatWork(const PhotographWork& work);
PhotographWork ParseWork(const std::string& line);

}  // namespace groundglass
