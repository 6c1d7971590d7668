// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/coverage.h"
#include "scene/frames.h"

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>

namespace groundglass {
namespace {

Eigen::Vector3d PointFromSiteJson(const nlohmann::json& point_in_site) {
  const auto [x, y, z] = point_in_site.get<std::array<double, 3>>();
  return WorldFromSite({x, y, z});
}

FaceCoverage FaceFromJson(const nlohmann::json& json) {
  FaceCoverage face;
  face.number = json.at("face").get<int>();
  face.name = json.at("name").get<std::string>();
  face.area = json.at("area").get<double>();
  face.covered_area = json.at("covered_area").get<double>();
  face.num_texels = json.at("texels").get<long>();
  face.num_covered_texels = json.at("covered_texels").get<long>();
  face.texel_size = json.at("texel_size").get<double>();
  for (const nlohmann::json& source : json.at("sources")) {
    face.sources.push_back({source.at("photograph").get<std::string>(),
                            source.at("texels").get<long>(),
                            source.at("footprint").get<double>()});
  }
  if (!json.contains("missing")) return face;
  const nlohmann::json& missing = json.at("missing");
  face.missing.emplace().centre_in_world = PointFromSiteJson(missing.at("centre"));
  if (missing.contains("stand_at")) {
    face.missing->stand_in_world = PointFromSiteJson(missing.at("stand_at"));
  }
  return face;
}

}  // namespace

std::string FormatCoverage(const Coverage& coverage) {
  // Ordered, so that a person finds the keys where the docs have them.
  using Json = nlohmann::ordered_json;
  Json document;
  document["covered_share"] = coverage.CoveredShare();
  document["faces"] = Json::array();
  for (const FaceCoverage& face : coverage.faces) {
    Json sources = Json::array();
    for (const FaceCoverage::Source& source : face.sources) {
      sources.push_back({{"photograph", source.photograph},
                         {"texels", source.num_texels},
                         {"footprint", source.footprint}});
    }
    document["faces"].push_back({{"face", face.number > 0 ? face.number : face.face + 1},
                                 {"name", face.name},
                                 {"area", face.area},
                                 {"covered_area", face.covered_area},
                                 {"texels", face.num_texels},
                                 {"covered_texels", face.num_covered_texels},
                                 {"texel_size", face.texel_size},
                                 {"sources", std::move(sources)}});
    if (!face.missing) continue;
    const auto site = [](const Eigen::Vector3d& point_in_world) {
      const Eigen::Vector3d point_in_site = SiteFromWorld(point_in_world);
      return Json{point_in_site.x(), point_in_site.y(), point_in_site.z()};
    };
    Json missing = {{"area", face.area - face.covered_area},
                    {"centre", site(face.missing->centre_in_world)}};
    if (face.missing->stand_in_world) missing["stand_at"] = site(*face.missing->stand_in_world);
    document["faces"].back()["missing"] = std::move(missing);
  }
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Coverage> ReadCoverage(const std::filesystem::path& file) {
  std::ifstream in(file);
  try {
    Coverage coverage;
    const nlohmann::json json = nlohmann::json::parse(in);
    for (const nlohmann::json& face : json.at("faces")) {
      coverage.faces.push_back(FaceFromJson(face));
    }
    return coverage;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace groundglass
