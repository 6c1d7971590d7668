// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/coverage.h"
#include "scene/frames.h"

#include <nlohmann/json.hpp>

namespace groundglass {

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
      const Eigen::Vector3d point_in_site = WorldFromSite(point_in_world);  // its own inverse
      return Json{point_in_site.x(), point_in_site.y(), point_in_site.z()};
    };
    Json missing = {{"area", face.area - face.covered_area},
                    {"centre", site(face.missing->centre_in_world)}};
    if (face.missing->stand_in_world) missing["stand_at"] = site(*face.missing->stand_in_world);
    document["faces"].back()["missing"] = std::move(missing);
  }
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace groundglass
