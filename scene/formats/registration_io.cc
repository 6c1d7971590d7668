// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/registration_io.h"

#include "scene/error.h"
#include "scene/formats/json_fault.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace groundglass {
namespace {

// Ordered, so that a person finds the keys where the docs have them.
using Json = nlohmann::ordered_json;

// Few cameras have k3, p1 and p2: left out where 0.
bool IsRare(int index) { return static_cast<TagKey>(index) >= TagKey::kK3; }

Json JsonFromTag(const ViewTag& tag) {
  Json json;
  for (int index = 0; index < kNumTagKeys; ++index) {
    if (IsRare(index) && GetTagValue(tag, static_cast<TagKey>(index)) == 0) continue;
    json[std::string(kTagKeyNames[index])] = GetTagValue(tag, static_cast<TagKey>(index));
  }
  for (const SigmaKey& key : kSigmaKeys) {
    if (const std::optional<double>& sigma = tag.sigmas.*(key.member))
      json[std::string(key.name)] = *sigma;
  }
  if (!tag.camera.empty()) json["camera"] = tag.camera;
  return json;
}

ViewTag TagFromJson(const Json& json) {
  ViewTag tag;
  for (int index = 0; index < kNumTagKeys; ++index) {
    const std::string key(kTagKeyNames[index]);
    if (IsRare(index) && !json.contains(key)) continue;
    SetTagValue(tag, static_cast<TagKey>(index), json.at(key).get<double>());
  }
  for (const SigmaKey& key : kSigmaKeys) {
    const std::string name(key.name);
    if (json.contains(name)) tag.sigmas.*(key.member) = json.at(name).get<double>();
  }
  tag.camera = json.value("camera", "");
  return tag;
}

Json JsonFromParameters(const CameraParameters& parameters) {
  Json json;
  for (int index = 0; index < kNumCameraParameters; ++index) {
    json[std::string(kCameraParameterNames[index])] = parameters[index];
  }
  return json;
}

CameraParameters ParametersFromJson(const Json& json) {
  CameraParameters parameters;
  for (int index = 0; index < kNumCameraParameters; ++index) {
    parameters[index] = json.at(std::string(kCameraParameterNames[index])).get<double>();
  }
  return parameters;
}

// null: there is no such number.
Json JsonFromOptional(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

std::optional<double> OptionalFromJson(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) return std::nullopt;
  return found->get<double>();
}

Verdict VerdictFromName(const std::string& name) {
  for (const Verdict verdict :
       {Verdict::kAccepted, Verdict::kReview, Verdict::kRejected, Verdict::kUnreadable}) {
    if (VerdictName(verdict) == name) return verdict;
  }
  throw Error("verdict '" + name + "' is not accepted, review, rejected or unreadable");
}

// To a hundredth of a pixel: rows of u, v and the offset.
Json JsonFromResiduals(const std::vector<EdgeResidual>& residuals) {
  const auto hundredths = [](double px) { return std::round(100 * px) / 100 + 0.0; };
  Json rows = Json::array();
  for (const EdgeResidual& residual : residuals) {
    rows.push_back({hundredths(residual.image_px.x()),
                    hundredths(residual.image_px.y()),
                    hundredths(residual.offset_px.x()),
                    hundredths(residual.offset_px.y())});
  }
  return rows;
}

std::vector<EdgeResidual> ResidualsFromJson(const Json& json) {
  std::vector<EdgeResidual> residuals;
  for (const Json& row : json) {
    residuals.push_back({{row.at(0).get<double>(), row.at(1).get<double>()},
                         {row.at(2).get<double>(), row.at(3).get<double>()}});
  }
  return residuals;
}

Json JsonFromRegistration(const Registration& registration) {
  Json json;
  json["name"] = registration.name;
  json["verdict"] = VerdictName(registration.verdict);
  json["reasons"] = registration.reasons;
  if (registration.verdict == Verdict::kUnreadable) return json;
  json["width_px"] = registration.width_px;
  json["height_px"] = registration.height_px;
  json["measured"] = JsonFromTag(registration.measured);
  json["corrected"] = JsonFromTag(registration.corrected);
  json["sigmas"] = JsonFromParameters(registration.sigmas);
  json["prior_sigmas"] = JsonFromParameters(registration.prior_sigmas);
  json["parameters"] = kCameraParameterNames;
  const CameraCovariance covariance_in_site = SiteCovariance(registration.covariance);
  json["covariance"] = Json::array();
  for (int row = 0; row < kNumCameraParameters; ++row) {
    Json values = Json::array();
    for (int column = 0; column < kNumCameraParameters; ++column) {
      values.push_back(covariance_in_site(row, column));
    }
    json["covariance"].push_back(std::move(values));
  }
  json["undetermined"] = registration.undetermined;
  json["num_samples"] = registration.num_samples;
  json["rms_px"] = JsonFromOptional(registration.rms_px);
  json["robust_sigma_px"] = JsonFromOptional(registration.robust_sigma_px);
  json["residuals"] = JsonFromResiduals(registration.residuals);
  json["score_nats"] = registration.score_nats;
  json["margin_nats"] = JsonFromOptional(registration.margin_nats);
  if (registration.rival) json["rival"] = JsonFromTag(*registration.rival);
  if (registration.ties) {
    json["ties"] = {{"tried", registration.ties->num_tried},
                    {"agreeing", registration.ties->num_agreeing},
                    {"nats", registration.ties->nats}};
  }
  json["moved_px"] = registration.moved_px;
  json["vertex_sigma_px"] = registration.vertex_sigma_px;
  return json;
}

// Throws Error for a tag that describes no camera.
void CheckTags(const Registration& registration) {
  const auto check = [&](const ViewTag& tag) {
    if (const std::optional<TagFault> fault = FindTagFault(tag)) {
      throw Error("photograph '" + registration.name + "': key '" + fault->key +
                  "': " + fault->message);
    }
  };
  check(registration.measured);
  check(registration.corrected);
  if (registration.rival) check(*registration.rival);
}

Registration RegistrationFromJson(const Json& json) {
  Registration registration;
  registration.name = json.at("name").get<std::string>();
  registration.verdict = VerdictFromName(json.at("verdict").get<std::string>());
  registration.reasons = json.at("reasons").get<std::vector<std::string>>();
  if (registration.verdict == Verdict::kUnreadable) return registration;
  registration.width_px = json.at("width_px").get<int>();
  registration.height_px = json.at("height_px").get<int>();
  if (registration.width_px < 1 || registration.height_px < 1) {
    throw Error("photograph '" + registration.name + "': width_px and height_px must be above 0");
  }
  registration.measured = TagFromJson(json.at("measured"));
  registration.corrected = TagFromJson(json.at("corrected"));
  // Not there where there is none, and before version 0.2.
  if (const auto rival = json.find("rival"); rival != json.end()) {
    registration.rival = TagFromJson(*rival);
  }
  CheckTags(registration);
  registration.sigmas = ParametersFromJson(json.at("sigmas"));
  registration.prior_sigmas = ParametersFromJson(json.at("prior_sigmas"));
  const Json& covariance = json.at("covariance");
  for (int row = 0; row < kNumCameraParameters; ++row) {
    for (int column = 0; column < kNumCameraParameters; ++column) {
      registration.covariance(row, column) = covariance.at(row).at(column).get<double>();
    }
  }
  registration.covariance = SiteCovariance(registration.covariance);
  registration.undetermined = json.at("undetermined").get<std::vector<std::string>>();
  registration.num_samples = json.at("num_samples").get<int>();
  if (json.contains("robust_sigma_px")) {
    registration.rms_px = OptionalFromJson(json, "rms_px");
    registration.robust_sigma_px = OptionalFromJson(json, "robust_sigma_px");
  } else {
    // Written by version 0.1, which called the robust spread rms_px.
    registration.robust_sigma_px = OptionalFromJson(json, "rms_px");
  }
  // Version 0.1 and what came soon after wrote none.
  if (const auto residuals = json.find("residuals"); residuals != json.end()) {
    registration.residuals = ResidualsFromJson(*residuals);
  }
  registration.score_nats = json.at("score_nats").get<double>();
  registration.margin_nats = OptionalFromJson(json, "margin_nats");
  if (const auto ties = json.find("ties"); ties != json.end()) {
    registration.ties = {ties->at("tried").get<int>(),
                         ties->at("agreeing").get<int>(),
                         ties->at("nats").get<double>()};
  }
  constexpr double kNoRivalOfVersion01 = 1e6;
  if (registration.margin_nats == kNoRivalOfVersion01) registration.margin_nats.reset();
  registration.moved_px = json.at("moved_px").get<double>();
  registration.vertex_sigma_px = json.at("vertex_sigma_px").get<double>();
  return registration;
}

Json JsonFromSite(const Eigen::Vector3d& in_world) {
  const Eigen::Vector3d in_site = SiteFromWorld(in_world);
  return {in_site.x(), in_site.y(), in_site.z()};
}

Eigen::Vector3d WorldFromJson(const Json& json) {
  return WorldFromSite(
      {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()});
}

Json JsonFromModelError(const ModelError& error) {
  Json json;
  json["name"] = error.name;
  json["start"] = JsonFromSite(error.start_in_world);
  json["end"] = JsonFromSite(error.end_in_world);
  json["offset"] = JsonFromSite(error.offset_in_world);
  json["sigma"] = error.sigma;
  json["photographs"] = error.photographs;
  json["num_photographs"] = error.photographs.size();
  if (error.with_the_one_before) json["with_the_one_before"] = true;
  return json;
}

Json JsonFromTieUse(const TieUse& ties) {
  Json json;
  json["patches"] = ties.patches;
  if (ties.colmap) {
    json["colmap"] = {{"version", ties.colmap->version},
                      {"sha256", ties.colmap->sha256},
                      {"photographs", ties.colmap->num_photographs},
                      {"pairs", ties.colmap->num_pairs},
                      {"tracks", ties.colmap->num_tracks}};
  }
  return json;
}

// What `read` makes of the file's JSON; errors name the file, in one line.
template <typename Read>
auto ReadDocument(const std::filesystem::path& file, Read read) {
  try {
    return read(Json::parse(ReadTextFile(file)));
  } catch (const Json::exception& error) {
    throw Error(file, "not a registration file: " + TellJsonFault(error.what()));
  } catch (const Error& error) {
    const std::string message = error.what();
    if (message.starts_with(file.string())) throw;
    throw Error(file, message);
  }
}

}  // namespace

std::string FormatRegistrations(const std::vector<Registration>& registrations,
                                const std::vector<ModelError>& model_errors,
                                const std::vector<std::string>& warnings,
                                const TieUse& ties) {
  Json document;
  document["photographs"] = Json::array();
  for (const Registration& registration : registrations) {
    document["photographs"].push_back(JsonFromRegistration(registration));
  }
  document["model_errors"] = Json::array();
  for (const ModelError& error : model_errors) {
    document["model_errors"].push_back(JsonFromModelError(error));
  }
  document["ties"] = JsonFromTieUse(ties);
  document["warnings"] = warnings;
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Registration> ReadRegistrations(const std::filesystem::path& file) {
  return ReadDocument(file, [](const Json& document) {
    std::vector<Registration> registrations;
    for (const Json& json : document.at("photographs")) {
      registrations.push_back(RegistrationFromJson(json));
    }
    return registrations;
  });
}

std::vector<ModelError> ReadModelErrors(const std::filesystem::path& file) {
  return ReadDocument(file, [](const Json& document) {
    std::vector<ModelError> errors;
    for (const Json& json : document.value("model_errors", Json::array())) {
      errors.push_back({json.at("name").get<std::string>(),
                        WorldFromJson(json.at("start")),
                        WorldFromJson(json.at("end")),
                        WorldFromJson(json.at("offset")),
                        json.at("sigma").get<double>(),
                        json.value("photographs", std::vector<std::string>()),
                        json.value("with_the_one_before", false)});
    }
    return errors;
  });
}

std::vector<std::string> ReadRegistrationWarnings(const std::filesystem::path& file) {
  return ReadDocument(file, [](const Json& document) {
    return document.value("warnings", std::vector<std::string>());
  });
}

TieUse ReadTieUse(const std::filesystem::path& file) {
  return ReadDocument(file, [](const Json& document) {
    TieUse ties;
    const Json json = document.value("ties", Json::object());
    ties.patches = json.value("patches", false);
    if (const auto colmap = json.find("colmap"); colmap != json.end()) {
      ties.colmap = {colmap->at("version").get<std::string>(),
                     colmap->at("sha256").get<std::string>(),
                     colmap->at("photographs").get<int>(),
                     colmap->at("pairs").get<int>(),
                     colmap->at("tracks").get<int>()};
    }
    return ties;
  });
}

}  // namespace groundglass
