// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/truth_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

Json JsonFromVector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json JsonFromActual(const ViewTag& tag) {
  return {{"C", JsonFromVector(tag.position_in_site)},
          {"L", JsonFromVector(tag.lookat_in_site)},
          {"roll", tag.roll_deg},
          {"v", tag.view_angle_deg}};
}

// The 3 x 4 matrix from left-handed site coordinates to scan pixels (without distortion).
Json JsonFromProjection(const Camera& camera) {
  Eigen::Matrix3d intrinsics;
  intrinsics << camera.focal_x_px, 0, camera.center_x_px,  //
      0, camera.focal_y_px, camera.center_y_px,            //
      0, 0, 1;
  Eigen::Matrix<double, 3, 4> projection;
  projection.leftCols<3>() = intrinsics * camera.cam_from_world.rotation;
  projection.col(3) = intrinsics * camera.cam_from_world.translation;
  projection.col(1) *= -1;
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    Json values = Json::array();
    for (int column = 0; column < 4; ++column) values.push_back(projection(row, column));
    rows.push_back(values);
  }
  return rows;
}

Json JsonFromPlan(const PhotographPlan& plan, const VertexError& tag_error) {
  Json json;
  json["name"] = plan.name;
  json["light"] = plan.light.is_sunny ? "sun" : "over";
  json["spot"] = plan.comment;
  json["true"] = JsonFromActual(plan.entry.actual);
  json["true"]["k1"] = plan.entry.actual.k1;
  json["tag"] = {{"C", JsonFromVector(plan.entry.measured.position_in_site)},
                 {"L", JsonFromVector(plan.entry.measured.lookat_in_site)},
                 {"a", plan.entry.measured.aspect},
                 {"v", plan.entry.measured.view_angle_deg}};
  json["blunder"] = std::string(BlunderName(plan.blunder));
  json["slide"] = {{"tx_px", plan.slide.shift_x_px},
                   {"ty_px", plan.slide.shift_y_px},
                   {"theta_deg", plan.slide.turn_deg},
                   {"scale", plan.slide.scale},
                   {"aniso", plan.slide.anisotropy}};
  json["photo"] = {{"ev", plan.photometry.exposure_stops},
                   {"wb", plan.photometry.white_balance},
                   {"vign", plan.photometry.vignetting},
                   {"grain", plan.photometry.grain},
                   {"blur_px", plan.photometry.blur_px},
                   {"motion_px", plan.photometry.motion_px},
                   {"motion_deg", plan.photometry.motion_deg},
                   {"defocus_px", plan.photometry.defocus_px}};
  json["tag_error_px"] = {{"n_vertices_in_frame", tag_error.num_points},
                          {"mean", tag_error.mean_px},
                          {"max", tag_error.max_px}};
  json["P34_LHworld_to_scan_px"] = JsonFromProjection(plan.written_camera);
  json["light_truth"] = {{"kind", plan.light.is_sunny ? "sun" : "overcast"},
                         {"sun_azimuth_deg_from_north_cw", nullptr},
                         {"sun_elevation_deg", nullptr}};
  if (plan.light.is_sunny) {
    json["light_truth"]["sun_azimuth_deg_from_north_cw"] = plan.sun_azimuth_deg;
    json["light_truth"]["sun_elevation_deg"] = plan.sun_elevation_deg;
  }
  return json;
}

// How the model is wrong: truth/model_exact.osu is what it means to show.
Json JsonFromModelErrors(const SynthRecipe& recipe, const PlannedScene& planned) {
  Json json = {{"sigma", recipe.random.model.sigma}, {"flaws", Json::array()}};
  for (const ModelFlaw& flaw : planned.model_flaws) {
    json["flaws"].push_back({{"what", flaw.what}, {"where", flaw.where}, {"offset", flaw.offset}});
  }
  return json;
}

}  // namespace

VertexError MeasureTagError(const PolygonModel& model, const PhotographPlan& plan) {
  return MeasureVertexError(
      model,
      plan.written_camera,
      CameraFromTag(
          plan.entry.measured, plan.written_camera.width_px, plan.written_camera.height_px));
}

int OccluderCodeOffset(const PolygonModel& model) {
  return model.faces.size() < kPerson ? 0 : kLargeModelOffset;
}

std::string FormatTruth(const SynthRecipe& recipe, const PlannedScene& planned) {
  const PolygonModel& model = planned.model;
  const std::vector<PhotographPlan>& plans = planned.photographs;
  Json json;
  json["scene"] = recipe.preset;
  json["units"] = "feet, left-handed x east, y south, z up";
  json["image"] = {plans.front().written_camera.width_px, plans.front().written_camera.height_px};
  json["novel_image"] = {recipe.width_px, recipe.height_px};
  json["n_faces"] = model.faces.size();
  json["n_points"] = model.points_in_world.size();
  json["slide_formula"] =
      "scan = centre + (tx, ty) + diag(scale (1 + aniso/2), scale (1 - aniso/2)) Rot(theta) "
      "(ideal - centre), theta clockwise on the screen";
  json["mask_codes"] = {{"0", "sky/ground/background"}, {"1..n", "face id (file order)"}};
  for (const auto& [code, name] : OccluderNames()) {
    json["mask_codes"][std::to_string(code + OccluderCodeOffset(model))] = name;
  }
  for (size_t face = 0; face < model.faces.size(); ++face) {
    json["face_names"][std::to_string(face + 1)] = model.faces[face].name;
  }
  if (planned.exact_model) json["model"] = JsonFromModelErrors(recipe, planned);
  double sum_px = 0;
  int num_without_blunder = 0;
  Json views = Json::array();
  for (const PhotographPlan& plan : plans) {
    const VertexError error = MeasureTagError(model, plan);
    if (plan.blunder == Blunder::kNone) {
      sum_px += error.mean_px;
      ++num_without_blunder;
    }
    views.push_back(JsonFromPlan(plan, error));
  }
  json["tag_error_px_mean_over_views"] = sum_px / std::max(1, num_without_blunder);
  json["views"] = views;
  json["novel"] = Json::array();
  for (const PlannedView& view : planned.novel_views) {
    ViewTag tag;
    tag.position_in_site = view.position_in_site;
    tag.lookat_in_site = view.lookat_in_site;
    tag.view_angle_deg = view.view_angle_deg;
    json["novel"].push_back(
        {{"name", view.name}, {"light", "over"}, {"true", JsonFromActual(tag)}});
  }
  return json.dump(1) + "\n";
}

}  // namespace groundglass
