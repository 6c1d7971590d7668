// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/answer.h"

#include "scene/error.h"
#include "scene/formats/csv.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

Json JsonOf(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }
Json JsonOf(const Eigen::Vector2d& vector) { return {vector.x(), vector.y()}; }

// The mirror that leads from `world` to `site` leaves squares as they are.
Json SigmasOf(const Eigen::Matrix3d& covariance) {
  return JsonOf(Eigen::Vector3d(covariance.diagonal().cwiseMax(0).cwiseSqrt()));
}

Json JsonOfCovariance(const Eigen::Matrix3d& in_world) {
  const Eigen::Vector3d mirror(1, -1, 1);
  const Eigen::Matrix3d in_site = mirror.asDiagonal() * in_world * mirror.asDiagonal();
  return {JsonOf(Eigen::Vector3d(in_site.row(0))),
          JsonOf(Eigen::Vector3d(in_site.row(1))),
          JsonOf(Eigen::Vector3d(in_site.row(2)))};
}

Json JsonOfMeasure(const Measure& measure) {
  return {{"value", measure.value},
          {"sigma", measure.sigma},
          {"sigma_camera", measure.camera_sigma},
          {"sigma_pixel", measure.pixel_sigma},
          {"sigma_model", measure.model_sigma}};
}

Json JsonOfSighting(const Survey& survey, const Sighting& sighting) {
  Json json = {{"photograph", survey.photographs[sighting.photograph].name},
               {"state", SightingStateName(sighting.state)}};
  if (!sighting.reason.empty()) json["reason"] = sighting.reason;
  if (!sighting.image_px) return json;
  json["image_px"] = JsonOf(*sighting.image_px);
  json["sigma_camera_px"] = sighting.camera_sigma_px;
  json["sigma_place_px"] = sighting.place_sigma_px;
  json["distance"] = sighting.distance;
  json["angle_deg"] = sighting.angle_deg;
  json["pixel_size"] = sighting.pixel_size;
  return json;
}

Json JsonOfFace(const Survey& survey, int face) {
  return {{"face", FaceNumber(survey.model, face)},
          {"name", survey.model.faces[face].name},
          {"area", ComputeFaceArea(survey.model, face)}};
}

Json JsonOfPlace(const Survey& survey, const Place& place, const std::vector<Sighting>& sightings) {
  Json json = {{"point", JsonOf(SiteFromWorld(place.point_in_world))},
               {"sigma", SigmasOf(place.Covariance())},
               {"sigma_camera", SigmasOf(place.Covariance(ErrorKind::kCamera))},
               {"sigma_pixel", SigmasOf(place.Covariance(ErrorKind::kPixel))},
               {"sigma_model", SigmasOf(place.Covariance(ErrorKind::kModel))},
               {"covariance", JsonOfCovariance(place.Covariance())}};
  if (place.photograph) {
    json["pointed_at"] = {{"photograph", survey.photographs[*place.photograph].name},
                          {"image_px", JsonOf(place.image_px)}};
  }
  json["faces"] = Json::array();
  for (const int face : place.faces) json["faces"].push_back(JsonOfFace(survey, face));
  json["distance_off_model"] = place.distance_off_model;
  const auto texel = place.faces.empty() ? std::nullopt : TexelSize(survey, place.faces.front());
  json["texel_size"] = texel ? Json(*texel) : Json();
  json["photographs"] = Json::array();
  for (const Sighting& sighting : sightings) {
    json["photographs"].push_back(JsonOfSighting(survey, sighting));
  }
  return json;
}

std::string CsvOfPlace(const Survey& survey, size_t index, const Place& place) {
  const Eigen::Vector3d point = SiteFromWorld(place.point_in_world);
  const Eigen::Vector3d sigma = place.Covariance().diagonal().cwiseMax(0).cwiseSqrt();
  std::string row = std::to_string(index + 1);
  for (int i = 0; i < 3; ++i) row += "," + FormatNumber(point[i]);
  for (int i = 0; i < 3; ++i) row += "," + FormatNumber(sigma[i]);
  if (place.faces.empty()) return row + ",,";
  const int face = place.faces.front();
  return row + "," + std::to_string(FaceNumber(survey.model, face)) + "," +
         CsvField(survey.model.faces[face].name);
}

}  // namespace

Answer AnswerPlaces(const Survey& survey,
                    const Visibility& visibility,
                    std::vector<Place> places,
                    const SightingOptions& options) {
  if (places.empty() || places.size() > 3) {
    throw Error("one to three places can be asked for at once, not " +
                std::to_string(places.size()));
  }
  Answer answer;
  answer.places = std::move(places);
  for (const Place& place : answer.places) {
    answer.sightings.push_back(FindSightings(survey, visibility, place, options));
  }
  if (answer.places.size() >= 2) {
    answer.distance = MeasureDistance(answer.places[0], answer.places[1]);
  }
  if (answer.places.size() == 3) {
    answer.area = MeasureArea(answer.places[0], answer.places[1], answer.places[2]);
  }
  return answer;
}

std::string FormatAnswerJson(const Survey& survey, const Answer& answer) {
  Json json = {{"unit", UnitName(survey.model.unit)}, {"places", Json::array()}};
  for (size_t i = 0; i < answer.places.size(); ++i) {
    json["places"].push_back(JsonOfPlace(survey, answer.places[i], answer.sightings[i]));
  }
  if (answer.distance) json["distance"] = JsonOfMeasure(*answer.distance);
  if (answer.area) json["area"] = JsonOfMeasure(*answer.area);
  json["left_out"] = Json::array();
  for (const LeftOutPhotograph& left_out : survey.left_out) {
    json["left_out"].push_back({{"photograph", left_out.name}, {"reason", left_out.reason}});
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string FormatAnswerCsv(const Survey& survey, const Answer& answer) {
  std::string csv =
      "place,x,y,z,sigma_x,sigma_y,sigma_z,face,name,photograph,state,x_px,y_px,sigma_px,distance,"
      "angle_deg,pixel_long,pixel_wide,reason\n";
  for (size_t i = 0; i < answer.places.size(); ++i) {
    const std::string place = CsvOfPlace(survey, i, answer.places[i]);
    for (const Sighting& sighting : answer.sightings[i]) {
      csv += place + "," + CsvField(survey.photographs[sighting.photograph].name) + "," +
             std::string(SightingStateName(sighting.state));
      if (sighting.image_px) {
        for (const double value : {sighting.image_px->x(),
                                   sighting.image_px->y(),
                                   sighting.camera_sigma_px,
                                   sighting.distance,
                                   sighting.angle_deg,
                                   sighting.pixel_size[0],
                                   sighting.pixel_size[1]}) {
          csv += "," + FormatNumber(value);
        }
      } else {
        csv += ",,,,,,,";
      }
      csv += "," + CsvField(sighting.reason) + "\n";
    }
  }
  return csv;
}

}  // namespace groundglass
