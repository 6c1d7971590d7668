// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/keep_joint.h"

#include "scene/formats/atomic_file.h"
#include "scene/frames.h"
#include "scene/registration.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

Json JsonOfVector(const Eigen::Vector3d& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

Json JsonOfNumbers(const CameraParameters& numbers) {
  Json json;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    json[std::string(kCameraParameterNames[i])] = numbers[i];
  }
  return json;
}

Json JsonOfCamera(const CameraPrior& prior, const CameraParameters& whitened) {
  return JsonOfNumbers(SiteParameters(prior.ParametersAt(whitened)));
}

double ToPhotograph(const JointStage& stage, size_t index) {
  return static_cast<double>(stage.widths_px[index]) / stage.photographs[index].prior.width_px;
}

Json JsonOfGiven(const JointStage& stage, size_t index) {
  const AlignedPhotograph& photograph = stage.photographs[index];
  return {{"name", stage.names[index]},
          {"lens", stage.lenses[index]},
          {"tag", JsonOfCamera(photograph.prior, CameraParameters::Zero())},
          {"tag_sigmas", JsonOfNumbers(photograph.prior.sigmas)},
          {"start", JsonOfCamera(photograph.prior, photograph.whitened)},
          {"samples", photograph.found.size()},
          {"noise_px", photograph.noise_px * ToPhotograph(stage, index)}};
}

Json JsonOfTie(const JointStage& stage, const TiePoint& tie) {
  Json seen = Json::array();
  for (const TieObservation& observation : tie.observations) {
    const auto index = static_cast<size_t>(observation.photograph);
    const Eigen::Vector2d at = observation.image_px * ToPhotograph(stage, index);
    seen.push_back({{"name", stage.names[index]}, {"image_px", {at.x(), at.y()}}});
  }
  return {{"point", JsonOfVector(SiteFromWorld(tie.point_in_world))}, {"seen", std::move(seen)}};
}

Json JsonOfFound(const JointStage& stage, size_t index) {
  const CameraPrior& prior = stage.photographs[index].prior;
  const JointSolution& solution = stage.joint.photographs[index];
  const CameraCovariance covariance = prior.root * solution.covariance * prior.root.transpose();
  Json json = {{"name", stage.names[index]},
               {"camera", JsonOfCamera(prior, solution.whitened)},
               {"sigmas", JsonOfNumbers(covariance.diagonal().cwiseMax(0).cwiseSqrt())},
               {"matched", solution.num_matched}};
  if (const std::optional<ResidualSpread> spread = SpreadOf(solution.residuals)) {
    json["rms_px"] = spread->rms_px * ToPhotograph(stage, index);
    json["robust_sigma_px"] = spread->robust_sigma_px * ToPhotograph(stage, index);
  }
  return json;
}

Json JsonOfDisplacement(const JointStage& stage, const EdgeDisplacement& displacement) {
  std::vector<std::string> names;
  for (const int photograph : displacement.photographs) names.push_back(stage.names[photograph]);
  return {
      {"edge", displacement.edge},
      {"start_moved", JsonOfVector(SiteFromWorld(displacement.start_in_world))},
      {"end_moved", JsonOfVector(SiteFromWorld(displacement.end_in_world))},
      {"middle_sigmas", JsonOfVector(displacement.covariance.diagonal().cwiseMax(0).cwiseSqrt())},
      {"photographs", names}};
}

std::string FormatJointStage(const JointStage& stage) {
  Json given = {{"photographs", Json::array()}, {"ties", Json::array()}};
  Json found = {{"photographs", Json::array()}, {"edges", Json::array()}};
  for (size_t i = 0; i < stage.photographs.size(); ++i) {
    given["photographs"].push_back(JsonOfGiven(stage, i));
    found["photographs"].push_back(JsonOfFound(stage, i));
  }
  for (const TiePoint& tie : stage.ties) given["ties"].push_back(JsonOfTie(stage, tie));
  for (const EdgeDisplacement& displacement : stage.joint.displacements) {
    found["edges"].push_back(JsonOfDisplacement(stage, displacement));
  }
  return Json{{"given", std::move(given)}, {"found", std::move(found)}}.dump(1) + "\n";
}

// One line for each candidate.
std::string FormatJointSamples(const AlignedPhotograph& photograph, double to_photograph) {
  std::string text =
      "sample,edge,along,image_x_px,image_y_px,normal_x,normal_y,candidate_offset_px,"
      "candidate_strength\n";
  for (size_t i = 0; i < photograph.found.size(); ++i) {
    const CandidateSample& found = photograph.found[i];
    const Eigen::Vector2d at = found.origin_px * to_photograph;
    std::string sample = std::to_string(i) + "," + std::to_string(found.sample.edge);
    for (const double number :
         {found.sample.along, at.x(), at.y(), found.normal.x(), found.normal.y()}) {
      sample += "," + FormatNumber(number);
    }
    for (const EdgeCandidate& candidate : found.candidates) {
      text += sample + "," + FormatNumber(candidate.offset_px * to_photograph) + "," +
              FormatNumber(candidate.strength) + "\n";
    }
  }
  return text;
}

}  // namespace

void KeepJointStage(const JointStage& stage, const std::filesystem::path& folder) {
  WriteFileAtomically(folder / "joint.json", FormatJointStage(stage));
  for (size_t i = 0; i < stage.photographs.size(); ++i) {
    WriteFileAtomically(folder / stage.names[i] / "joint_samples.csv",
                        FormatJointSamples(stage.photographs[i], ToPhotograph(stage, i)));
  }
}

}  // namespace groundglass
