// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/embedded_picture.h"
#include "report/report_data.h"
#include "report/report_text.h"
#include "scene/formats/image_io.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
namespace mustache = kainjow::mustache;

// A tag's numbers in words, in the order of kCameraParameterNames.
struct ParameterWords {
  const char* name;
  const char* unit;  // empty: the model's
};
constexpr std::array<ParameterWords, kNumCameraParameters> kParameterWords = {{
    {"position, east (x)", ""},
    {"position, south (y)", ""},
    {"height (z)", ""},
    {"direction (yaw)", "\u00b0"},
    {"upward tilt (pitch)", "\u00b0"},
    {"roll", "\u00b0"},
    {"angle of view (v)", "\u00b0"},
    {"aspect (a)", " "},
    {"shift, right (shift_x)", " of width"},
    {"shift, down (shift_y)", " of width"},
    {"lens distortion (k1)", " "},
}};

// As tables of adjustments draw them; said in the template too.
constexpr double kResidualsEnlarged = 10;

// A misfit that there may not be.
std::string PixelsOf(const std::optional<double>& px) {
  return px ? FormatRounded(*px, 0.1) : kNoNumber;
}

mustache::data TableRowData(const Registration& registration) {
  const bool is_corrected = HasCorrection(registration.verdict);
  const auto if_corrected = [&](double px) {
    return is_corrected ? FormatRounded(px, 1) : kNoNumber;
  };
  mustache::data row;
  row["name"] = registration.name;
  row["verdict"] = std::string(VerdictName(registration.verdict));
  row["moved_px"] = if_corrected(registration.moved_px);
  row["rms_px"] = PixelsOf(registration.rms_px);
  row["robust_sigma_px"] = PixelsOf(registration.robust_sigma_px);
  row["vertex_sigma_px"] = if_corrected(registration.vertex_sigma_px);
  row["num_samples"] = std::to_string(registration.num_samples);
  row["reasons"] = TextListData(registration.reasons);
  return row;
}

// Lines as an SVG path in tenths of pixels; what is shorter than a pixel is left out.
std::string EdgePath(const std::vector<std::vector<Eigen::Vector2d>>& lines) {
  const auto tenths = [](double px) { return FormatNumber(std::round(10 * px) / 10 + 0.0); };
  std::string path;
  for (const std::vector<Eigen::Vector2d>& line : lines) {
    if (line.size() < 2 || (line.back() - line.front()).norm() < 1) continue;
    for (size_t i = 0; i < line.size(); ++i) {
      path += (i == 0 ? "M" : "L") + tenths(line[i].x()) + " " + tenths(line[i].y());
    }
  }
  return path;
}

// From each piece of a corrected edge to the photograph's, kResidualsEnlarged times as far, as an
// SVG path; its place and length in a picture of another size. Empty if the registration has none.
std::string ResidualPath(const Registration& registration, int width_px) {
  const double scale = static_cast<double>(width_px) / registration.width_px;
  std::vector<std::vector<Eigen::Vector2d>> lines;
  for (const EdgeResidual& residual : registration.residuals) {
    const Eigen::Vector2d start_px = scale * residual.image_px;
    lines.push_back({start_px, start_px + kResidualsEnlarged * scale * residual.offset_px});
  }
  return EdgePath(lines);
}

// The photograph, and over it the edges as measured and as corrected, and what the corrected ones
// still miss the photograph's by; false without scene.
mustache::data WipeData(const Registration& registration, const ReportInput& input) {
  const ReportOptions& options = input.options;
  const Photograph* photograph = input.scene && options.find_edges
                                     ? FindUsablePhotograph(*input.scene, registration.name)
                                     : nullptr;
  if (!photograph) return false;
  mustache::data wipe = PictureData(
      ReadSrgb8(photograph->image_file), options.picture_width_px, input.photograph_bytes);
  const int width_px = std::stoi(wipe["width"].string_value());
  const int height_px = std::stoi(wipe["height"].string_value());
  const auto path = [&](const Camera& camera) {
    return EdgePath(options.find_edges(ResizedCamera(camera, width_px, height_px)));
  };
  wipe["measured"] = path(registration.MeasuredCamera());
  wipe["corrected"] = false;
  wipe["residuals"] = false;
  if (HasCorrection(registration.verdict)) {
    wipe["corrected"] = mustache::data("path", path(registration.CorrectedCamera()));
    const std::string residuals = ResidualPath(registration, width_px);
    if (!residuals.empty()) wipe["residuals"] = mustache::data("path", residuals);
  }
  return wipe;
}

// The photograph as overlays/ has it; false if it has not.
mustache::data OverlayData(const Registration& registration, const ReportInput& input) {
  const fs::path overlay = input.folder / "overlays" / (registration.name + ".jpg");
  if (!fs::exists(overlay)) return false;
  return PictureData(ReadSrgb8(overlay), input.options.picture_width_px, input.photograph_bytes);
}

// One number of the tag, in `site`; moved: corrected less measured.
mustache::data NumberRowData(const Registration& registration,
                             int i,
                             double measured,
                             double moved,
                             const std::string& unit) {
  const double sigma = registration.sigmas[i];
  const double prior = registration.prior_sigmas[i];
  const std::vector<std::string>& undetermined = registration.undetermined;
  mustache::data row;
  row["what"] = kParameterWords[i].name;
  row["measured"] = FormatRounded(measured, sigma) + unit;
  row["corrected"] = FormatRounded(measured + moved, sigma) + unit;
  row["sigma"] = sigma > 0 ? FormatSigma(sigma) + unit : kNoNumber;
  row["moved"] = FormatRounded(moved, sigma) + unit;
  row["in_expected_errors"] = prior > 0 ? FormatRounded(std::abs(moved) / prior, 1) : kNoNumber;
  row["is_undetermined"] =
      std::find(undetermined.begin(), undetermined.end(), kCameraParameterNames[i]) !=
      undetermined.end();
  return row;
}

mustache::data NumbersData(const Registration& registration, const ReportInput& input) {
  if (!HasCorrection(registration.verdict)) return false;
  const CameraParameters measured = SiteParameters(ParametersFromTag(registration.measured));
  const CameraParameters corrected = SiteParameters(ParametersFromTag(registration.corrected));
  mustache::list rows;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    double moved = corrected[i] - measured[i];
    if (i == kYaw) moved = std::remainder(moved, 360.0);
    // A number that nothing was done to says nothing.
    if (registration.sigmas[i] <= 0 && moved == 0) continue;
    const std::string unit = *kParameterWords[i].unit ? kParameterWords[i].unit : input.unit;
    rows.push_back(NumberRowData(registration, i, measured[i], moved, unit));
  }
  return {"rows", rows};
}

mustache::data PhotographData(const Registration& registration, const ReportInput& input) {
  mustache::data data;
  data["name"] = registration.name;
  data["verdict"] = std::string(VerdictName(registration.verdict));
  data["remarks"] = false;
  if (!registration.reasons.empty()) {
    data["remarks"] = mustache::data("reasons", TextListData(registration.reasons));
  }
  const bool is_readable = registration.verdict != Verdict::kUnreadable;
  data["in_words"] = CorrectionInWords(registration, input.unit);
  data["wipe"] = is_readable ? WipeData(registration, input) : false;
  const bool has_wipe = !data["wipe"].is_false();
  data["overlay"] = is_readable && !has_wipe ? OverlayData(registration, input) : false;
  data["numbers"] = NumbersData(registration, input);
  return data;
}

}  // namespace

mustache::data PhotographTableData(const ReportInput& input) {
  if (!input.registrations) return false;
  mustache::list rows;
  bool with_unreadable = false;
  for (const Registration& registration : *input.registrations) {
    rows.push_back(TableRowData(registration));
    with_unreadable = with_unreadable || registration.verdict == Verdict::kUnreadable;
  }
  mustache::data data;
  data["with_unreadable"] = with_unreadable;
  data["model_sigma"] = false;
  if (input.scene) data["model_sigma"] = DescribeModelSigma(input.scene->model);
  data["rows"] = rows;
  return data;
}

mustache::data PhotographsData(const ReportInput& input) {
  if (!input.registrations) return false;
  mustache::list photographs;
  for (const Registration& registration : *input.registrations) {
    photographs.push_back(PhotographData(registration, input));
  }
  return {"list", photographs};
}

}  // namespace groundglass
