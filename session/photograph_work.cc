// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/photograph_work.h"

#include "scene/error.h"
#include "scene/formats/view_io.h"

#include <nlohmann/json.hpp>

namespace groundglass {
namespace {

using Json = nlohmann::json;

template <typename Vector>
Json JsonOfVector(const Vector& vector) {
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}

template <typename Vector>
void ReadVector(const Json& json, Vector& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) vector[i] = json.at(i).get<double>();
}

// As a view file has it, which has the shortest digits that read back exactly.
Json JsonOfTag(const std::optional<ViewTag>& tag) { return tag ? Json(FormatView(*tag)) : Json(); }

std::optional<ViewTag> TagOfJson(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return ParseView(json.get<std::string>(), "journal");
}

template <typename T>
Json JsonOfOptional(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

std::optional<double> NumberOfJson(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<double>();
}

Json JsonOfNews(const AlignmentNews& news) {
  return {{"verdict", static_cast<int>(news.verdict)},
          {"reasons", news.reasons},
          {"corrected", JsonOfTag(news.corrected)},
          {"moved_px", news.moved_px},
          {"vertex_sigma_px", news.vertex_sigma_px},
          {"rms_px", JsonOfOptional(news.rms_px)},
          {"margin_nats", JsonOfOptional(news.margin_nats)},
          {"undetermined", news.undetermined},
          {"rival", JsonOfTag(news.rival)}};
}

AlignmentNews NewsOfJson(const Json& json) {
  AlignmentNews news;
  news.verdict = static_cast<Verdict>(json.at("verdict").get<int>());
  json.at("reasons").get_to(news.reasons);
  news.corrected = TagOfJson(json.at("corrected")).value();
  json.at("moved_px").get_to(news.moved_px);
  json.at("vertex_sigma_px").get_to(news.vertex_sigma_px);
  news.rms_px = NumberOfJson(json.at("rms_px"));
  news.margin_nats = NumberOfJson(json.at("margin_nats"));
  json.at("undetermined").get_to(news.undetermined);
  news.rival = TagOfJson(json.value("rival", Json()));
  return news;
}

}  // namespace

std::string FormatWork(const PhotographWork& work) {
  Json points = Json::array();
  for (const PointPin& pin : work.pins.points) {
    points.push_back({{"point", JsonOfVector(pin.point_in_world)},
                      {"px", JsonOfVector(pin.image_px)},
                      {"sigma_px", pin.sigma_px},
                      {"use", static_cast<int>(pin.use)}});
  }
  Json lines = Json::array();
  for (const LinePin& pin : work.pins.lines) {
    lines.push_back({{"start", JsonOfVector(pin.start_in_world)},
                     {"end", JsonOfVector(pin.end_in_world)},
                     {"first_px", JsonOfVector(pin.first_px)},
                     {"second_px", JsonOfVector(pin.second_px)},
                     {"sigma_px", pin.sigma_px},
                     {"use", static_cast<int>(pin.use)}});
  }
  const Json json = {{"tag", JsonOfTag(work.tag)},
                     {"points", points},
                     {"lines", lines},
                     {"alignment", work.alignment ? JsonOfNews(*work.alignment) : Json()},
                     {"accepted", JsonOfTag(work.accepted)},
                     {"overruled", work.overruled}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

PhotographWork ParseWork(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    PhotographWork work;
    work.tag = TagOfJson(json.at("tag"));
    for (const Json& point : json.at("points")) {
      PointPin& pin = work.pins.points.emplace_back();
      ReadVector(point.at("point"), pin.point_in_world);
      ReadVector(point.at("px"), pin.image_px);
      point.at("sigma_px").get_to(pin.sigma_px);
      pin.use = static_cast<PinUse>(point.at("use").get<int>());
    }
    for (const Json& from : json.at("lines")) {
      LinePin& pin = work.pins.lines.emplace_back();
      ReadVector(from.at("start"), pin.start_in_world);
      ReadVector(from.at("end"), pin.end_in_world);
      ReadVector(from.at("first_px"), pin.first_px);
      ReadVector(from.at("second_px"), pin.second_px);
      from.at("sigma_px").get_to(pin.sigma_px);
      pin.use = static_cast<PinUse>(from.at("use").get<int>());
    }
    if (!json.at("alignment").is_null()) work.alignment = NewsOfJson(json.at("alignment"));
    work.accepted = TagOfJson(json.at("accepted"));
    json.at("overruled").get_to(work.overruled);
    return work;
  } catch (const std::exception& error) {
    throw Error(std::string("not a line of a journal: ") + error.what());
  }
}

}  // namespace groundglass
