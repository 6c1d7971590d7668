// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_data.h"
#include "report/report_text.h"
#include "scene/error.h"
#include "scene/formats/json_fault.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

using Json = nlohmann::json;
namespace mustache = kainjow::mustache;

// A face of which less than this is seen is pointed out.
constexpr double kWellCovered = 0.5;
// Photographs that give a face less than this are not named.
constexpr double kNamedSource = 0.05;

double SeenShare(const Json& face) {
  const double area = face.value("area", 0.0);
  return area > 0 ? face.value("covered_area", 0.0) / area : 0;
}

bool IsMissing(const Json& face) { return SeenShare(face) < kWellCovered; }

// Which photographs a face's texels come from.
void AddSources(const Json& face, mustache::data& row) {
  const double texels = face.value("covered_texels", 0.0);
  mustache::list sources;
  size_t num_left_out = 0;
  for (const Json& source : face.value("sources", Json::array())) {
    const double part = texels > 0 ? source.value("texels", 0.0) / texels : 0;
    if (part < kNamedSource) {
      ++num_left_out;
      continue;
    }
    mustache::data entry;
    entry["photograph"] = source.value("photograph", "");
    entry["part"] = FormatShare(part);
    entry["is_later"] = !sources.empty();
    sources.push_back(std::move(entry));
  }
  row["sources"] = sources;
  row["num_left_out"] = false;
  if (num_left_out > 0) row["num_left_out"] = std::to_string(num_left_out);
}

// "232, -104, 5": where to stand, in `site`.
std::string FormatStandpoint(const Json& face) {
  const Json missing = face.value("missing", Json::object());
  const auto at = missing.value("stand_at", std::vector<double>());
  std::string text;
  for (const double coordinate : at) {
    text += (text.empty() ? "" : ", ") + FormatRounded(coordinate, 10);
  }
  return text.empty() ? kNoNumber : text;
}

mustache::data FaceRowData(const Json& face, bool with_standpoint) {
  const double share = SeenShare(face);
  const bool has_texels = face.value("covered_texels", 0.0) > 0;
  mustache::data row;
  row["is_missing"] = IsMissing(face);
  row["number"] = std::to_string(face.value("face", 0));
  row["name"] = face.value("name", "");
  row["area"] = FormatRounded(face.value("area", 0.0), 1);
  row["share"] = FormatShare(share);
  row["percent"] = std::to_string(std::lround(100 * std::clamp(share, 0.0, 1.0)));
  row["texel_size"] = has_texels ? FormatSigma(face.value("texel_size", 0.0)) : kNoNumber;
  AddSources(face, row);
  row["with_standpoint"] = with_standpoint;
  row["standpoint"] = with_standpoint ? FormatStandpoint(face) : "";
  return row;
}

mustache::data CoverageDataOf(const Json& coverage) {
  const std::vector<Json> faces = coverage.value("faces", std::vector<Json>());
  mustache::list rows;
  mustache::list missing_rows;
  for (const Json& face : faces) {
    rows.push_back(FaceRowData(face, false));
    if (IsMissing(face)) missing_rows.push_back(FaceRowData(face, true));
  }
  mustache::data data;
  data["covered_share"] = FormatShare(coverage.value("covered_share", 0.0));
  data["num_faces"] = Plural(faces.size(), "face");
  data["faces"] = rows;
  data["missing"] = false;
  if (!missing_rows.empty()) {
    mustache::data missing;
    missing["faces_are"] =
        Plural(missing_rows.size(), "face") + (missing_rows.size() == 1 ? " is" : " are");
    missing["faces"] = missing_rows;
    data["missing"] = std::move(missing);
  }
  return data;
}

}  // namespace

namespace {

// How much area each photograph gives to the texture, largest first.
mustache::data ProvenanceDataOf(const Json& coverage, const std::string& unit) {
  std::map<std::string, double> area_of_photograph;
  double all = 0;
  for (const Json& face : coverage.value("faces", std::vector<Json>())) {
    const double texel = face.value("texel_size", 0.0);
    for (const Json& source : face.value("sources", Json::array())) {
      const double area = source.value("texels", 0.0) * texel * texel;
      area_of_photograph[source.value("photograph", "")] += area;
      all += area;
    }
  }
  if (!(all > 0)) return false;
  std::vector<std::pair<std::string, double>> sorted(area_of_photograph.begin(),
                                                     area_of_photograph.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.second > b.second;
  });
  mustache::list rows;
  for (const auto& [name, area] : sorted) {
    mustache::data row;
    row["name"] = name;
    row["area"] = FormatSigma(area) + unit + "\u00b2";
    row["share"] = FormatShare(area / all);
    row["percent"] = std::to_string(std::lround(100 * area / all));
    rows.push_back(std::move(row));
  }
  return {"rows", rows};
}

// What `make` makes of coverage.json; Error if it is of another shape.
template <typename Make>
mustache::data FromCoverage(const ReportInput& input, const Make& make) {
  if (!input.coverage) return false;
  try {
    return make(*input.coverage);
  } catch (const Json::exception& error) {
    throw Error(input.folder / "coverage.json",
                "is not as texturing writes it: " + TellJsonFault(error.what()));
  }
}

}  // namespace

mustache::data CoverageData(const ReportInput& input) {
  return FromCoverage(input, CoverageDataOf);
}

mustache::data ProvenanceData(const ReportInput& input) {
  return FromCoverage(input,
                      [&](const Json& coverage) { return ProvenanceDataOf(coverage, input.unit); });
}

}  // namespace groundglass
