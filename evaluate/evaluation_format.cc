// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/evaluate.h"
#include "scene/face_number.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace groundglass {
namespace {

// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string Printed(const char* format, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

// "0.123+-0.045", or the error alone where nothing is claimed.
std::string WithSigma(double error, const std::optional<double>& sigma, int decimals) {
  std::string text = Printed("%.*f", decimals, error);
  if (sigma) text += Printed("+-%.*f", decimals, *sigma);
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

std::array<ParameterErrors, kNumCameraParameters> ParametersOf(const Evaluation& evaluation) {
  std::vector<PhotographParameters> photographs;
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    if (photograph.parameters) photographs.push_back(*photograph.parameters);
  }
  return SummariseParameters(photographs);
}

std::string FormatSummary(const char* title, const ErrorSummary& summary) {
  return Printed("%s: mean %.2f px, median %.2f px, max %.2f px (%d photographs)\n",
                 title,
                 summary.mean_px,
                 summary.median_px,
                 summary.max_px,
                 summary.count);
}

nlohmann::ordered_json JsonFromSummary(const ErrorSummary& summary) {
  return {{"count", summary.count},
          {"mean_px", summary.mean_px},
          {"median_px", summary.median_px},
          {"max_px", summary.max_px}};
}

nlohmann::ordered_json JsonFromPicture(const PictureErrors& errors) {
  return {{"psnr_db", errors.psnr_db},
          {"ssim", errors.ssim},
          {"coverage", errors.coverage},
          {"num_pixels", errors.num_pixels},
          {"gain", errors.gain}};
}

nlohmann::ordered_json JsonFromParameters(const CameraParameters& parameters) {
  nlohmann::ordered_json json;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    json[std::string(kCameraParameterNames[i])] = parameters[i];
  }
  return json;
}

}  // namespace

std::string FormatEvaluationTable(const Evaluation& evaluation, const PolygonModel& model) {
  const std::string unit = UnitName(model.unit);
  std::string text = Printed("%-10s %9s %9s %16s %16s %16s %16s %18s  %s\n",
                             "photograph",
                             "vertex px",
                             "max px",
                             Printed("position %s", unit.c_str()).c_str(),
                             "direction deg",
                             "roll deg",
                             "v deg",
                             "shift",
                             "verdict");
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    const CameraErrors& errors = photograph.errors;
    const Sigmas sigmas = CombineSigmas(photograph);
    std::string verdict = photograph.verdict ? std::string(VerdictName(*photograph.verdict)) : "-";
    if (photograph.is_wrong_accepted) verdict += " WRONG";
    if (photograph.calibration && !photograph.calibration->is_inside_95) {
      verdict += " (outside its 95 %)";
    }
    text += Printed(
        "%-10s %9.2f %9.2f %16s %16s %16s %16s %18s  %s\n",
        photograph.name.c_str(),
        errors.vertex.mean_px,
        errors.vertex.max_px,
        WithSigma(errors.position, sigmas.position, 3).c_str(),
        WithSigma(errors.direction_deg, sigmas.direction_deg, 3).c_str(),
        WithSigma(errors.parameters[kRoll], sigmas.roll_deg, 3).c_str(),
        WithSigma(errors.parameters[kViewAngle], sigmas.view_angle_deg, 3).c_str(),
        WithSigma(
            std::hypot(errors.parameters[kShiftX], errors.parameters[kShiftY]), sigmas.shift, 4)
            .c_str(),
        verdict.c_str());
  }
  if (evaluation.photographs.empty()) text.clear();
  if (evaluation.all.count > 0) text += FormatSummary("vertex error", evaluation.all);
  const bool has_verdicts =
      std::any_of(evaluation.photographs.begin(),
                  evaluation.photographs.end(),
                  [](const PhotographEvaluation& p) { return p.verdict.has_value(); });
  if (has_verdicts) {
    text += FormatSummary("accepted", evaluation.accepted);
    text += Printed("wrong accepted: %d\n", evaluation.num_wrong_accepted);
  }
  if (evaluation.num_calibrated > 0) {
    text += Printed("truth inside the 95 %% ellipsoid: %d of %d\n",
                    evaluation.num_inside_95,
                    evaluation.num_calibrated);
  }
  text += FormatParameterTable(ParametersOf(evaluation), unit);
  for (const std::string& name : evaluation.missing) text += "no camera for " + name + "\n";
  if (!evaluation.faces.empty()) {
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
    if (count > 0) {
      text += Printed("face masks: mean IoU %.4f over %d faces, worst %.4f for %s\n",
                      sum / count,
                      count,
                      evaluation.faces[worst].IntersectionOverUnion(),
                      DescribeFace(model, worst).c_str());
    }
  }
  for (const NovelViewEvaluation& view : evaluation.novel_views) {
    text += Printed("novel view %s: PSNR %.2f dB, SSIM %.4f, coverage %.1f %%",
                    view.name.c_str(),
                    view.errors.psnr_db,
                    view.errors.ssim,
                    100 * view.errors.coverage);
    if (view.oracle) {
      text += Printed("; oracle %.2f dB, %.4f, %.1f %%",
                      view.oracle->psnr_db,
                      view.oracle->ssim,
                      100 * view.oracle->coverage);
    }
    text += "\n";
  }
  if (!evaluation.why_no_oracle.empty()) text += "no oracle: " + evaluation.why_no_oracle + "\n";
  if (evaluation.texels) {
    text += Printed("texels: RMS %.2f levels of 255 over %ld covered of %ld exact ones\n",
                    evaluation.texels->rms_levels,
                    evaluation.texels->num_covered,
                    evaluation.texels->num_texels);
    std::vector<std::pair<double, int>> rms_of_face;
    for (size_t i = 0; i < evaluation.texels->faces.size(); ++i) {
      const TexelErrors::OfFace& face = evaluation.texels->faces[i];
      if (face.num_covered > 0) rms_of_face.emplace_back(face.rms_levels, static_cast<int>(i));
    }
    if (!rms_of_face.empty()) {
      std::sort(rms_of_face.begin(), rms_of_face.end());
      text += Printed("texels by face: median %.2f levels, worst %.2f for %s\n",
                      rms_of_face[rms_of_face.size() / 2].first,
                      rms_of_face.back().first,
                      DescribeFace(model, rms_of_face.back().second).c_str());
    }
  }
  return text;
}

std::string FormatEvaluationJson(const Evaluation& evaluation, const PolygonModel& model) {
  nlohmann::ordered_json json;
  json["unit"] = UnitName(model.unit);
  json["photographs"] = nlohmann::ordered_json::array();
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    nlohmann::ordered_json entry;
    entry["name"] = photograph.name;
    if (photograph.verdict) entry["verdict"] = std::string(VerdictName(*photograph.verdict));
    entry["wrong_accepted"] = photograph.is_wrong_accepted;
    entry["vertex_error_px"] = photograph.errors.vertex.mean_px;
    if (photograph.start_px) entry["start_px"] = *photograph.start_px;
    entry["vertex_error_max_px"] = photograph.errors.vertex.max_px;
    entry["num_points"] = photograph.errors.vertex.num_points;
    entry["position_error"] = photograph.errors.position;
    entry["direction_error_deg"] = photograph.errors.direction_deg;
    entry["errors"] = JsonFromParameters(SiteChange(photograph.errors.parameters));
    if (photograph.sigmas) entry["sigmas"] = JsonFromParameters(*photograph.sigmas);
    if (photograph.calibration) {
      entry["mahalanobis_squared"] = photograph.calibration->mahalanobis_squared;
      entry["degrees_of_freedom"] = photograph.calibration->degrees_of_freedom;
      entry["inside_95"] = photograph.calibration->is_inside_95;
    }
    json["photographs"].push_back(entry);
  }
  json["missing"] = evaluation.missing;
  json["all"] = JsonFromSummary(evaluation.all);
  json["accepted"] = JsonFromSummary(evaluation.accepted);
  json["num_wrong_accepted"] = evaluation.num_wrong_accepted;
  json["num_inside_95"] = evaluation.num_inside_95;
  json["num_calibrated"] = evaluation.num_calibrated;
  const std::array<ParameterErrors, kNumCameraParameters> parameters = ParametersOf(evaluation);
  for (int i = 0; i < kNumCameraParameters && parameters[i].count > 0; ++i) {
    const ParameterErrors& errors = parameters[i];
    nlohmann::ordered_json entry = {{"rms_tag", errors.rms_tag},
                                    {"rms_found", errors.rms_found},
                                    {"rms_sigma", errors.rms_sigma},
                                    {"rms_in_sigmas", errors.rms_in_sigmas},
                                    {"worst_in_sigmas", errors.worst_in_sigmas},
                                    {"sigma_over_prior", errors.sigma_over_prior}};
    if (errors.partner >= 0) {
      entry["partner"] = std::string(kCameraParameterNames[errors.partner]);
      entry["partner_correlation"] = errors.partner_correlation;
    }
    json["parameters"][std::string(kCameraParameterNames[i])] = entry;
  }
  json["faces"] = nlohmann::ordered_json::array();
  for (size_t i = 0; i < evaluation.faces.size(); ++i) {
    if (evaluation.faces[i].union_px == 0) continue;
    json["faces"].push_back({{"face", FaceNumber(model, static_cast<int>(i))},
                             {"name", model.faces[i].name},
                             {"iou", evaluation.faces[i].IntersectionOverUnion()},
                             {"union_px", evaluation.faces[i].union_px}});
  }
  json["novel_views"] = nlohmann::ordered_json::array();
  for (const NovelViewEvaluation& view : evaluation.novel_views) {
    nlohmann::ordered_json entry = {{"name", view.name}};
    entry.update(JsonFromPicture(view.errors));
    if (view.oracle) entry["oracle"] = JsonFromPicture(*view.oracle);
    json["novel_views"].push_back(entry);
  }
  if (!evaluation.why_no_oracle.empty()) json["why_no_oracle"] = evaluation.why_no_oracle;
  if (evaluation.texels) {
    json["texels"] = {{"rms_levels", evaluation.texels->rms_levels},
                      {"num_texels", evaluation.texels->num_texels},
                      {"num_covered", evaluation.texels->num_covered},
                      {"gain", evaluation.texels->gain}};
    json["texels"]["faces"] = nlohmann::ordered_json::array();
    for (size_t i = 0; i < evaluation.texels->faces.size(); ++i) {
      const TexelErrors::OfFace& face = evaluation.texels->faces[i];
      if (face.num_covered == 0) continue;
      json["texels"]["faces"].push_back({{"face", FaceNumber(model, static_cast<int>(i))},
                                         {"num_texels", face.num_texels},
                                         {"num_covered", face.num_covered},
                                         {"rms_levels", face.rms_levels}});
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace groundglass
