// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/synth.h"

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/camera_errors.h"
#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/notebook.h"
#include "datasets-synthetic/ray_tracer.h"
#include "datasets-synthetic/slide.h"
#include "scene/atomic_file.h"
#include "scene/colmap_io.h"
#include "scene/error.h"
#include "scene/image_io.h"
#include "scene/osu_io.h"
#include "scene/view_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Everything about one photograph that chance or plan has decided, before a ray is shot.
struct PhotographPlan {
  std::string name;
  std::string comment;
  NotebookEntry entry;
  SlideTransform slide;
  Photometry photometry;
  Daylight light;
  double sun_azimuth_deg = 0;
  double sun_elevation_deg = 0;
  Camera camera;  // the slide's transform folded in
};

PhotographPlan PlanPhotograph(const PlannedView& view, const SynthRecipe& recipe, int index) {
  PhotographPlan plan;
  plan.name = view.name;
  plan.comment = view.comment;
  const double aspect = static_cast<double>(recipe.width_px) / recipe.height_px;
  plan.entry = MakeNotebookEntry(view, aspect, recipe, index);

  const uint64_t slide_seed = SeedFor(recipe.seed, "slide", index);
  const auto slide_normal = [&](int which) { return NormalOf(HashOf(slide_seed, which)); };
  plan.slide.shift_x_px = recipe.slide.sigma_shift * recipe.width_px * slide_normal(0);
  plan.slide.shift_y_px = recipe.slide.sigma_shift * recipe.width_px * slide_normal(1);
  plan.slide.turn_deg = recipe.slide.sigma_turn_deg * slide_normal(2);
  plan.slide.scale = 1 + recipe.slide.sigma_scale * slide_normal(3);
  plan.slide.anisotropy = recipe.slide.sigma_anisotropy * slide_normal(4);
  plan.camera =
      FoldInSlide(CameraFromTag(plan.entry.actual, recipe.width_px, recipe.height_px), plan.slide);

  const uint64_t photo_seed = SeedFor(recipe.seed, "photo", index);
  const auto photo_normal = [&](int which) { return NormalOf(HashOf(photo_seed, which)); };
  plan.photometry.exposure_stops = recipe.photo.sigma_exposure_stops * photo_normal(0);
  plan.photometry.white_balance = {std::exp(recipe.photo.sigma_white_balance * photo_normal(1)),
                                   1,
                                   std::exp(recipe.photo.sigma_white_balance * photo_normal(2))};
  plan.photometry.vignetting = recipe.photo.max_vignetting * UniformOf(HashOf(photo_seed, 3));
  plan.photometry.grain = recipe.photo.grain * (0.7 + 0.6 * UniformOf(HashOf(photo_seed, 4)));
  plan.photometry.blur_px = recipe.photo.blur_px * (0.8 + 0.4 * UniformOf(HashOf(photo_seed, 5)));

  const uint64_t light_seed = SeedFor(recipe.seed, "light", index);
  if (UniformOf(HashOf(light_seed, 0)) < recipe.photo.sunny_share) {
    // People photograph with the sun behind them or to one side: never far into it.
    const Eigen::Vector3d away =
        plan.entry.actual.position_in_site - plan.entry.actual.lookat_in_site;
    const double behind_deg = DegreesFromRadians(std::atan2(away.x(), -away.y()));
    double azimuth_deg = behind_deg + 140 * (UniformOf(HashOf(light_seed, 1)) - 0.5);
    azimuth_deg -= 360 * std::floor(azimuth_deg / 360);
    // At the latitude of Boston it rises no further north than east-north-east.
    plan.sun_azimuth_deg = std::clamp(azimuth_deg, 75.0, 285.0);
    const double noon = std::cos(RadiansFromDegrees(plan.sun_azimuth_deg - 180) / 1.3);
    plan.sun_elevation_deg = 12 + 42 * std::max(0.0, noon) + 8 * UniformOf(HashOf(light_seed, 2));
    plan.light = MakeSunny(plan.sun_azimuth_deg, plan.sun_elevation_deg, light_seed);
  } else {
    plan.light = MakeOvercast(light_seed);
  }
  return plan;
}

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
  json["slide"] = {{"tx_px", plan.slide.shift_x_px},
                   {"ty_px", plan.slide.shift_y_px},
                   {"theta_deg", plan.slide.turn_deg},
                   {"scale", plan.slide.scale},
                   {"aniso", plan.slide.anisotropy}};
  json["photo"] = {{"ev", plan.photometry.exposure_stops},
                   {"wb", plan.photometry.white_balance},
                   {"vign", plan.photometry.vignetting},
                   {"grain", plan.photometry.grain},
                   {"blur_px", plan.photometry.blur_px}};
  json["tag_error_px"] = {{"n_vertices_in_frame", tag_error.num_points},
                          {"mean", tag_error.mean_px},
                          {"max", tag_error.max_px}};
  json["P34_LHworld_to_scan_px"] = JsonFromProjection(plan.camera);
  json["light_truth"] = {{"kind", plan.light.is_sunny ? "sun" : "overcast"},
                         {"sun_azimuth_deg_from_north_cw", nullptr},
                         {"sun_elevation_deg", nullptr}};
  if (plan.light.is_sunny) {
    json["light_truth"]["sun_azimuth_deg_from_north_cw"] = plan.sun_azimuth_deg;
    json["light_truth"]["sun_elevation_deg"] = plan.sun_elevation_deg;
  }
  return json;
}

Json MakeTruthJson(const SynthRecipe& recipe,
                   const PolygonModel& model,
                   const std::vector<PhotographPlan>& plans,
                   const std::vector<PlannedView>& novel_views,
                   SynthSummary& summary) {
  Json json;
  json["scene"] = recipe.preset;
  json["units"] = "feet, left-handed x east, y south, z up";
  json["image"] = {recipe.width_px, recipe.height_px};
  json["n_faces"] = model.faces.size();
  json["n_points"] = model.points_in_world.size();
  json["slide_formula"] =
      "scan = centre + (tx, ty) + diag(scale (1 + aniso/2), scale (1 - aniso/2)) Rot(theta) "
      "(ideal - centre), theta clockwise on the screen";
  json["mask_codes"] = {{"0", "sky/ground/background"}, {"1..n", "face id (file order)"}};
  for (size_t face = 0; face < model.faces.size(); ++face) {
    json["face_names"][std::to_string(face + 1)] = model.faces[face].name;
  }
  std::vector<double> errors_px;
  Json views = Json::array();
  for (const PhotographPlan& plan : plans) {
    const VertexError error = MeasureVertexError(
        model, plan.camera, CameraFromTag(plan.entry.measured, recipe.width_px, recipe.height_px));
    errors_px.push_back(error.mean_px);
    summary.mean_tag_error_px += error.mean_px / static_cast<double>(plans.size());
    views.push_back(JsonFromPlan(plan, error));
  }
  json["tag_error_px_mean_over_views"] = summary.mean_tag_error_px;
  json["views"] = views;
  json["novel"] = Json::array();
  for (const PlannedView& view : novel_views) {
    ViewTag tag;
    tag.position_in_site = view.position_in_site;
    tag.lookat_in_site = view.lookat_in_site;
    tag.view_angle_deg = view.view_angle_deg;
    json["novel"].push_back(
        {{"name", view.name}, {"light", "over"}, {"true", JsonFromActual(tag)}});
  }
  return json;
}

std::string ViewComment(const std::string& name, const std::string& spot) {
  std::string comment = "File: " + name + ".view";
  if (!spot.empty()) comment += "\n" + spot;
  return comment;
}

void CheckFolderIsFree(const fs::path& folder) {
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder))) {
    throw Error(folder, "already there and not empty; a synthetic scene needs a folder of its own");
  }
}

}  // namespace

SynthSummary WriteSyntheticScene(const SynthRecipe& recipe,
                                 const fs::path& folder,
                                 const Progress& progress) {
  recipe.Check();
  CheckFolderIsFree(folder);
  Subject subject = MakeWiesner(recipe.seed);
  const PolygonModel model = subject.world.Model();
  if (recipe.num_views > 0 && recipe.num_views < static_cast<int>(subject.views.size())) {
    subject.views.resize(recipe.num_views);
  }
  std::vector<PhotographPlan> plans;
  for (size_t i = 0; i < subject.views.size(); ++i) {
    plans.push_back(PlanPhotograph(subject.views[i], recipe, static_cast<int>(i)));
  }
  SynthSummary summary;
  summary.num_faces = static_cast<int>(model.faces.size());
  summary.num_photographs = static_cast<int>(plans.size());
  summary.num_novel_views = static_cast<int>(subject.novel_views.size());

  // What is cheap and says everything comes first; pictures follow.
  const fs::path truth = folder / "truth";
  WriteFileAtomically(folder / "model.osu", FormatOsu(model));
  WriteFileAtomically(folder / "recipe.json", FormatRecipe(recipe));
  WriteFileAtomically(
      truth / "truth.json",
      MakeTruthJson(recipe, model, plans, subject.novel_views, summary).dump(1) + "\n");
  std::vector<NamedCamera> cameras;
  for (const PhotographPlan& plan : plans) cameras.push_back({plan.name + ".jpg", plan.camera});
  WriteColmapModel(truth / "cameras", cameras);
  for (const PhotographPlan& plan : plans) {
    WriteFileAtomically(folder / "views" / (plan.name + ".view"),
                        FormatView(plan.entry.measured, ViewComment(plan.name, plan.comment)));
  }

  const Visibility model_visibility(model);
  const Visibility world_visibility(subject.world.geometry);
  const Box bounds = ComputeBounds(model);
  const SkyMap sky_map(subject.world, world_visibility, bounds.Center(), 1.5 * bounds.Diagonal());
  const int num_steps = summary.num_photographs + summary.num_novel_views;
  int num_done = 0;
  for (size_t i = 0; i < plans.size(); ++i) {
    const PhotographPlan& plan = plans[i];
    const RayScene scene{subject.world, world_visibility, sky_map, plan.light};
    const ImageF radiance = RenderRadiance(scene, plan.camera, SeedFor(recipe.seed, "rays", i));
    WriteSrgb8(folder / "images" / (plan.name + ".jpg"),
               DevelopPhotograph(
                   radiance, plan.camera, plan.photometry, SeedFor(recipe.seed, "grain", i)));
    const Image16 labels = model_visibility.FaceLabels(plan.camera);
    WriteLabels(truth / "masks_model" / (plan.name + ".png"), labels);
    WriteLabels(truth / "masks_occ" / (plan.name + ".png"), labels);
    if (progress) progress(++num_done, num_steps, plan.name);
  }
  for (const PlannedView& view : subject.novel_views) {
    ViewTag tag;
    tag.position_in_site = view.position_in_site;
    tag.lookat_in_site = view.lookat_in_site;
    tag.view_angle_deg = view.view_angle_deg;
    tag.aspect = static_cast<double>(recipe.width_px) / recipe.height_px;
    const Camera camera = CameraFromTag(tag, recipe.width_px, recipe.height_px);
    const RayScene scene{
        subject.world, world_visibility, sky_map, MakeOvercast(SeedFor(recipe.seed, "novel"))};
    const fs::path novel = truth / "novel";
    WriteFileAtomically(
        novel / (view.name + ".view"),
        FormatView(tag, ViewComment(view.name, "Held out: exact, and no slide errors")));
    WriteSrgb8(novel / (view.name + ".png"),
               DevelopPhotograph(RenderRadiance(scene, camera, SeedFor(recipe.seed, view.name)),
                                 camera,
                                 Photometry(),
                                 0));
    WriteLabels(novel / (view.name + "_faces.png"), model_visibility.FaceLabels(camera));
    if (progress) progress(++num_done, num_steps, view.name);
  }
  return summary;
}

}  // namespace groundglass
