// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/check_report.h"

#include "cli/printed_zero.h"
#include "scene/advice/standpoint.h"
#include "scene/assumed_unit.h"
#include "scene/building_bounds.h"
#include "scene/formats/text_encoding.h"
#include "scene/model_sigma.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

std::string FormatSize(const Eigen::Vector3d& size, double scale, const std::string& unit) {
  return fmt::format(
      "{:.4g} x {:.4g} x {:.4g} {}", size.x() * scale, size.y() * scale, size.z() * scale, unit);
}

std::vector<Standpoint> FindStandpoints(const Scene& scene) {
  std::vector<Standpoint> standpoints;
  if (scene.model.faces.empty()) return standpoints;
  const Visibility visibility(scene.model);
  const Box bounds = ComputeBuildingBounds(scene.model);
  for (const Photograph& photograph : scene.photographs) {
    standpoints.push_back(
        FindStandpoint(bounds, visibility, scene.model, photograph.tag, photograph.size));
  }
  return standpoints;
}

std::string LooksAt(const PolygonModel& model, const Standpoint& standpoint) {
  if (standpoint.face < 0) return standpoint.model_share > 0 ? "beside it" : "-";
  return DescribeFace(model, standpoint.face) + (standpoint.shows_front ? "" : ", its back");
}

std::string FormatCameraTable(const Scene& scene) {
  const std::vector<Standpoint> standpoints = FindStandpoints(scene);
  if (standpoints.empty()) return "";
  const std::string unit = UnitName(scene.model.unit);
  // People measure their places less well than a building is.
  const int decimals = std::max(0, LengthDecimals(scene.model) - 1);
  int width = 10;
  for (const Photograph& photograph : scene.photographs) {
    width = std::max(width, DisplayWidth(photograph.name));
  }
  std::string table = fmt::format("\n{}  {:>9} {:>9} {:>8}  {:<8} {:>9}  {:>6}  {}\n",
                                  PaddedTo(width, "photograph"),
                                  "x",
                                  "y",
                                  "z, " + unit,
                                  "stands",
                                  "distance",
                                  "angle",
                                  "looks at");
  for (size_t i = 0; i < standpoints.size(); ++i) {
    const Standpoint& standpoint = standpoints[i];
    table += fmt::format("{}  {:9.{}f} {:9.{}f} {:8.{}f}  {:<8} {:9.4g}  {:6.1f}  {}\n",
                         PaddedTo(width, scene.photographs[i].name),
                         ZeroIfRounded(standpoint.position_in_site.x(), decimals),
                         decimals,
                         ZeroIfRounded(standpoint.position_in_site.y(), decimals),
                         decimals,
                         ZeroIfRounded(standpoint.position_in_site.z(), decimals),
                         decimals,
                         standpoint.bearing,
                         standpoint.distance,
                         scene.photographs[i].tag.view_angle_deg,
                         LooksAt(scene.model, standpoint));
  }
  return table;
}

std::string Count(size_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

}  // namespace

std::string FormatModelSummary(const PolygonModel& model, const ModelArguments& arguments) {
  if (model.faces.empty()) return "";
  const Box bounds = ComputeBounds(model);
  const Eigen::Vector3d size = bounds.max - bounds.min;
  const std::string unit = UnitName(model.unit);
  std::string text = "model       " + Count(model.points_in_world.size(), "point") + ", " +
                     Count(model.faces.size(), "face") + "; " + FormatSize(size, 1, unit);
  if (model.unit != LengthUnit::kMetre) {
    text += " (" + FormatSize(size, MetresPerUnit(model.unit), "m") + ")";
  }
  text += "\nunit        " + unit;
  text += arguments.unit          ? std::string(", as --unit says")
          : model.is_unit_assumed ? ", " + std::string(kAssumedUnit)
                                  : ", as the file says";
  return text + "\ntolerance   " + DescribeTolerance(model, arguments) + "\n";
}

std::string FormatCheckReport(const CheckReport& report, const ModelArguments& arguments) {
  const Scene& scene = report.check.scene;
  std::string text = FormatModelSummary(scene.model, arguments) + FormatCameraTable(scene);
  if (!text.empty()) text += "\n";
  for (const std::string& note : scene.notes) text += "note: " + note + "\n";
  for (const std::string& fault : report.check.faults) text += "fault: " + fault + "\n";
  for (const std::string& warning : scene.warnings) text += "warning: " + warning + "\n";
  for (const Advice& advice : report.oddities) text += "warning: " + FormatAdvice(advice) + "\n";
  return text + Count(scene.photographs.size(), "photograph") + " with " +
         (scene.photographs.size() == 1 ? "a tag" : "tags") + ", " +
         Count(scene.model.points_in_world.size(), "point") + ", " +
         Count(scene.model.faces.size(), "face") + "; " +
         Count(report.check.faults.size(), "fault") + ", " +
         Count(report.NumWarnings(), "warning") + "\n";
}

namespace {

// Null where no model could be read: nothing is known of its unit.
Json ModelJson(const PolygonModel& model, const ModelArguments& arguments) {
  if (model.faces.empty()) return nullptr;
  const Box bounds = ComputeBounds(model);
  const Eigen::Vector3d size = bounds.max - bounds.min;
  return {{"unit", UnitName(model.unit)},
          {"unit_is_assumed", model.is_unit_assumed},
          {"size", {size.x(), size.y(), size.z()}},
          {"metres_per_unit", MetresPerUnit(model.unit)},
          {"tolerance", DescribeTolerance(model, arguments)}};
}

}  // namespace

std::string FormatCheckReportJson(const CheckReport& report, const ModelArguments& arguments) {
  const Scene& scene = report.check.scene;
  const PolygonModel& model = scene.model;
  Json json;
  json["faults"] = report.check.faults;
  std::vector<std::string> warnings = scene.warnings;
  for (const Advice& advice : report.oddities) warnings.push_back(FormatAdvice(advice));
  json["warnings"] = warnings;
  json["notes"] = scene.notes;
  json["oddities"] = Json::array();
  for (const Advice& advice : report.oddities) {
    json["oddities"].push_back(
        {{"concerns", advice.severity == Advice::Severity::kScene ? "scene" : "detail"},
         {"subject", advice.subject},
         {"message", advice.message},
         {"remedy", advice.remedy}});
  }
  json["points"] = model.points_in_world.size();
  json["faces"] = model.faces.size();
  json["model"] = ModelJson(model, arguments);
  json["photographs"] = Json::array();
  const std::vector<Standpoint> standpoints = FindStandpoints(scene);
  for (size_t i = 0; i < scene.photographs.size(); ++i) {
    const Photograph& photograph = scene.photographs[i];
    Json entry = {{"name", photograph.name},
                  {"image", photograph.image_file.string()},
                  {"width_px", photograph.size.width},
                  {"height_px", photograph.size.height}};
    if (i < standpoints.size()) {
      const Standpoint& standpoint = standpoints[i];
      const Eigen::Vector3d& position = standpoint.position_in_site;
      entry["position_in_site"] = {position.x(), position.y(), position.z()};
      entry["stands"] = standpoint.bearing;
      entry["distance"] = standpoint.distance;
      entry["view_angle_deg"] = photograph.tag.view_angle_deg;
      entry["looks_at"] = LooksAt(model, standpoint);
      entry["model_share"] = standpoint.model_share;
    }
    json["photographs"].push_back(std::move(entry));
  }
  json["overlays"] = report.overlays;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace groundglass
