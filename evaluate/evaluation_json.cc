// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/evaluate.h"
#include "scene/face_number.h"

#include <nlohmann/json.hpp>

namespace groundglass {
namespace {

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

nlohmann::ordered_json JsonFromPhotograph(const PhotographEvaluation& photograph) {
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
  return entry;
}

nlohmann::ordered_json JsonFromParameterErrors(const ParameterErrors& errors) {
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
  return entry;
}

nlohmann::ordered_json JsonFromTexels(const TexelErrors& texels, const PolygonModel& model) {
  nlohmann::ordered_json json = {{"rms_levels", texels.rms_levels},
                                 {"num_texels", texels.num_texels},
                                 {"num_covered", texels.num_covered},
                                 {"gain", texels.gain}};
  json["faces"] = nlohmann::ordered_json::array();
  for (size_t i = 0; i < texels.faces.size(); ++i) {
    const TexelErrors::OfFace& face = texels.faces[i];
    if (face.num_covered == 0) continue;
    json["faces"].push_back({{"face", FaceNumber(model, static_cast<int>(i))},
                             {"num_texels", face.num_texels},
                             {"num_covered", face.num_covered},
                             {"rms_levels", face.rms_levels}});
  }
  return json;
}

}  // namespace

std::string FormatEvaluationJson(const Evaluation& evaluation, const PolygonModel& model) {
  nlohmann::ordered_json json;
  json["unit"] = UnitName(model.unit);
  json["photographs"] = nlohmann::ordered_json::array();
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    json["photographs"].push_back(JsonFromPhotograph(photograph));
  }
  json["missing"] = evaluation.missing;
  json["all"] = JsonFromSummary(evaluation.all);
  json["accepted"] = JsonFromSummary(evaluation.accepted);
  json["num_wrong_accepted"] = evaluation.num_wrong_accepted;
  json["num_inside_95"] = evaluation.num_inside_95;
  json["num_calibrated"] = evaluation.num_calibrated;
  const std::array<ParameterErrors, kNumCameraParameters> parameters =
      SummariseParameters(evaluation);
  for (int i = 0; i < kNumCameraParameters && parameters[i].count > 0; ++i) {
    json["parameters"][std::string(kCameraParameterNames[i])] =
        JsonFromParameterErrors(parameters[i]);
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
  if (evaluation.texels) json["texels"] = JsonFromTexels(*evaluation.texels, model);
  return json.dump(2) + "\n";
}

}  // namespace groundglass
