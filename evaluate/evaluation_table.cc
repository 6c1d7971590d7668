// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/evaluate.h"
#include "scene/face_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// "0.123+-0.045", or the error alone where nothing is claimed.
std::string WithSigma(double error, const std::optional<double>& sigma, int decimals) {
  std::string text = fmt::format("{:.{}f}", error, decimals);
  if (sigma) text += fmt::format("+-{:.{}f}", *sigma, decimals);
  return text;
}

struct Sigmas {
  std::optional<double> position, direction_deg, roll_deg, view_angle_deg, shift;
};

// The claimed deviations of the table's columns; distances combine their axes, and the yaw counts
// in full, since buildings are looked at nearly level.
Sigmas CombineSigmas(const PhotographEvaluation& photograph) {
  Sigmas sigmas;
  if (!photograph.sigmas) return sigmas;
  const CameraParameters& s = *photograph.sigmas;
  sigmas.position = s.head<3>().norm();
  sigmas.direction_deg = std::hypot(s[kYaw], s[kPitch]);
  sigmas.roll_deg = s[kRoll];
  sigmas.view_angle_deg = s[kViewAngle];
  sigmas.shift = std::hypot(s[kShiftX], s[kShiftY]);
  return sigmas;
}

std::string FormatSummary(const char* title, const ErrorSummary& summary) {
  return fmt::format("{}: mean {:.2f} px, median {:.2f} px, max {:.2f} px ({} photographs)\n",
                     title,
                     summary.mean_px,
                     summary.median_px,
                     summary.max_px,
                     summary.count);
}

std::string FormatPhotographRow(const PhotographEvaluation& photograph) {
  const CameraErrors& errors = photograph.errors;
  const Sigmas sigmas = CombineSigmas(photograph);
  const double shift = std::hypot(errors.parameters[kShiftX], errors.parameters[kShiftY]);
  std::string verdict = photograph.verdict ? std::string(VerdictName(*photograph.verdict)) : "-";
  if (photograph.is_wrong_accepted) verdict += " WRONG";
  if (photograph.calibration && !photograph.calibration->is_inside_95) {
    verdict += " (outside its 95 %)";
  }
  return fmt::format("{:<10} {:9.2f} {:9.2f} {:>16} {:>16} {:>16} {:>16} {:>18}  {}\n",
                     photograph.name,
                     errors.vertex.mean_px,
                     errors.vertex.max_px,
                     WithSigma(errors.position, sigmas.position, 3),
                     WithSigma(errors.direction_deg, sigmas.direction_deg, 3),
                     WithSigma(errors.parameters[kRoll], sigmas.roll_deg, 3),
                     WithSigma(errors.parameters[kViewAngle], sigmas.view_angle_deg, 3),
                     WithSigma(shift, sigmas.shift, 4),
                     verdict);
}

std::string FormatPhotographs(const Evaluation& evaluation, const std::string& unit) {
  if (evaluation.photographs.empty()) return "";
  std::string text = fmt::format("{:<10} {:>9} {:>9} {:>16} {:>16} {:>16} {:>16} {:>18}  {}\n",
                                 "photograph",
                                 "vertex px",
                                 "max px",
                                 fmt::format("position {}", unit),
                                 "direction deg",
                                 "roll deg",
                                 "v deg",
                                 "shift",
                                 "verdict");
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    text += FormatPhotographRow(photograph);
  }
  return text;
}

// What holds of all cameras together.
std::string FormatCameras(const Evaluation& evaluation) {
  std::string text;
  if (evaluation.all.count > 0) text += FormatSummary("vertex error", evaluation.all);
  const bool has_verdicts =
      std::any_of(evaluation.photographs.begin(),
                  evaluation.photographs.end(),
                  [](const PhotographEvaluation& p) { return p.verdict.has_value(); });
  if (has_verdicts) {
    text += FormatSummary("accepted", evaluation.accepted);
    text += fmt::format("wrong accepted: {}\n", evaluation.num_wrong_accepted);
  }
  if (evaluation.num_calibrated > 0) {
    text += fmt::format("truth inside the 95 % ellipsoid: {} of {}\n",
                        evaluation.num_inside_95,
                        evaluation.num_calibrated);
  }
  return text;
}

// How well the masks of faces cover those of the true cameras.
std::string FormatFaceMasks(const Evaluation& evaluation, const PolygonModel& model) {
  double sum = 0;
  int count = 0;
  int worst = -1;
  for (size_t i = 0; i < evaluation.faces.size(); ++i) {
    if (evaluation.faces[i].union_px == 0) continue;
    sum += evaluation.faces[i].IntersectionOverUnion();
    ++count;
    if (worst < 0 || evaluation.faces[i].IntersectionOverUnion() <
                         evaluation.faces[worst].IntersectionOverUnion()) {
      worst = static_cast<int>(i);
    }
  }
  if (count == 0) return "";
  return fmt::format("face masks: mean IoU {:.4f} over {} faces, worst {:.4f} for {}\n",
                     sum / count,
                     count,
                     evaluation.faces[worst].IntersectionOverUnion(),
                     DescribeFace(model, worst));
}

std::string FormatNovelViews(const Evaluation& evaluation) {
  std::string text;
  for (const NovelViewEvaluation& view : evaluation.novel_views) {
    text += fmt::format("novel view {}: PSNR {:.2f} dB, SSIM {:.4f}, coverage {:.1f} %",
                        view.name,
                        view.errors.psnr_db,
                        view.errors.ssim,
                        100 * view.errors.coverage);
    if (view.oracle) {
      text += fmt::format("; oracle {:.2f} dB, {:.4f}, {:.1f} %",
                          view.oracle->psnr_db,
                          view.oracle->ssim,
                          100 * view.oracle->coverage);
    }
    text += "\n";
  }
  if (!evaluation.why_no_oracle.empty()) text += "no oracle: " + evaluation.why_no_oracle + "\n";
  return text;
}

std::string FormatTexels(const TexelErrors& texels, const PolygonModel& model) {
  std::string text =
      fmt::format("texels: RMS {:.2f} levels of 255 over {} covered of {} exact ones\n",
                  texels.rms_levels,
                  texels.num_covered,
                  texels.num_texels);
  std::vector<std::pair<double, int>> rms_of_face;
  for (size_t i = 0; i < texels.faces.size(); ++i) {
    const TexelErrors::OfFace& face = texels.faces[i];
    if (face.num_covered > 0) rms_of_face.emplace_back(face.rms_levels, static_cast<int>(i));
  }
  if (!rms_of_face.empty()) {
    std::sort(rms_of_face.begin(), rms_of_face.end());
    text += fmt::format("texels by face: median {:.2f} levels, worst {:.2f} for {}\n",
                        rms_of_face[rms_of_face.size() / 2].first,
                        rms_of_face.back().first,
                        DescribeFace(model, rms_of_face.back().second));
  }
  return text;
}

}  // namespace

std::string FormatEvaluationTable(const Evaluation& evaluation, const PolygonModel& model) {
  const std::string unit = UnitName(model.unit);
  std::string text = FormatPhotographs(evaluation, unit) + FormatCameras(evaluation) +
                     FormatParameterTable(SummariseParameters(evaluation), unit);
  for (const std::string& name : evaluation.missing) text += "no camera for " + name + "\n";
  text += FormatFaceMasks(evaluation, model) + FormatNovelViews(evaluation);
  if (evaluation.texels) text += FormatTexels(*evaluation.texels, model);
  return text;
}

}  // namespace groundglass
