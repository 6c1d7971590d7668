// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_data.h"
#include "report/report_text.h"

#include <array>
#include <cctype>
#include <cmath>

namespace groundglass {
namespace {

// What a person says of a number that grew, and of one that shrank.
struct ChangeWords {
  const char* before;
  const char* grew;
  const char* shrank;
};
constexpr std::array<ChangeWords, kK1> kChangeWords = {{
    {"stood ", " further east", " further west"},
    {"stood ", " further south", " further north"},
    {"held ", " higher", " lower"},
    {"looked ", " further left", " further right"},
    {"looked ", " higher", " lower"},
    {"turned ", " clockwise", " counterclockwise"},
    {"angle of view ", " wider", " narrower"},
    {"picture stretched by ", " across", " upwards"},
    {"slide shifted ", " right", " left"},
    {"slide shifted ", " down", " up"},
}};

// Told only where the correction is more than its own uncertainty, and no trifle beside what the
// field notes were expected to miss by.
constexpr double kLeastSigmas = 2;
constexpr double kLeastExpected = 0.3;

// To two digits: a sentence is no table.
std::string AmountOf(int parameter,
                     double moved,
                     const Registration& registration,
                     const std::string& unit) {
  moved = std::abs(moved);
  if (parameter <= kPositionZ) return FormatSigma(moved) + unit;
  if (parameter <= kViewAngle) return FormatSigma(moved) + "\u00b0";
  if (parameter == kAspect) return FormatSigma(100 * moved) + " %";
  return FormatSigma(moved * registration.width_px) + " px";
}

}  // namespace

std::string CorrectionInWords(const Registration& registration, const std::string& unit) {
  if (!HasCorrection(registration.verdict)) return "";
  const CameraParameters measured = SiteParameters(ParametersFromTag(registration.measured));
  const CameraParameters corrected = SiteParameters(ParametersFromTag(registration.corrected));
  std::string text;
  const char* last_before = "";
  for (int i = 0; i < kK1; ++i) {
    double moved = corrected[i] - measured[i];
    if (i == kYaw) moved = std::remainder(moved, 360.0);
    const double sigma = registration.sigmas[i];
    if (!(sigma > 0) || std::abs(moved) < kLeastSigmas * sigma ||
        std::abs(moved) < kLeastExpected * registration.prior_sigmas[i]) {
      continue;
    }
    const ChangeWords& words = kChangeWords[i];
    const bool is_same_verb = std::string(last_before) == words.before;
    text += is_same_verb ? " and " : (text.empty() ? "" : ", ") + std::string(words.before);
    text += AmountOf(i, moved, registration, unit) + (moved > 0 ? words.grew : words.shrank);
    last_before = words.before;
  }
  if (text.empty()) return "As the field notes have it, within what they are sure to.";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ", compared with the field notes.";
}

}  // namespace groundglass
