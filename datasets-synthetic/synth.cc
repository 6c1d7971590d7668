// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/synth.h"

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/digitizer.h"
#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/planned_scene.h"
#include "datasets-synthetic/ray_tracer.h"
#include "datasets-synthetic/surface_truth.h"
#include "datasets-synthetic/truth_json.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/view_io.h"
#include "scene/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

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

// The face or the thing that each pixel's centre shows: where the building is seen, relief and all,
// the model's face there (`model_labels`, from 1); the codes of what stands before it; 0 for the
// ground, the sky and the distance.
Image16 OccludedLabels(const SyntheticWorld& world,
                       const Visibility& visibility,
                       const Camera& camera,
                       const Image16& model_labels,
                       int code_offset) {
  Image16 labels(camera.width_px, camera.height_px, 1);
  const Eigen::Vector3d position = camera.PositionInWorld();
  tbb::parallel_for(0, camera.height_px, [&](int y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const auto hit = visibility.FirstHit(position, UnprojectToWorld(camera, {x + 0.5, y + 0.5}));
      if (!hit) continue;
      const Surface& surface = world.surfaces[hit->face];
      if (surface.mask_code != 0) {
        *labels.At(x, y) = static_cast<uint16_t>(surface.mask_code + code_offset);
      } else if (hit->face < world.num_model_faces || surface.is_relief) {
        *labels.At(x, y) = *model_labels.At(x, y);
      }
    }
  });
  return labels;
}

void MarkMount(const MountOpening& opening, const PhotographPlan& plan, int code, Image16& labels) {
  // Labels may have been made for the video frame: its pixels' centres lie in the scan.
  const double scale_x = static_cast<double>(plan.camera.width_px) / labels.width;
  const double scale_y = static_cast<double>(plan.camera.height_px) / labels.height;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const Eigen::Vector2d scan_px((x + 0.5) * scale_x, (y + 0.5) * scale_y);
      if (DepthInOpening(
              opening, plan.slide, scan_px, plan.camera.width_px, plan.camera.height_px) < 0) {
        *labels.At(x, y) = static_cast<uint16_t>(code);
      }
    }
  }
}

// Renders, develops, mounts and digitises a photograph, and writes it with its masks.
void WritePhotograph(const SynthRecipe& recipe,
                     const PhotographPlan& plan,
                     int index,
                     const RayScene& scene,
                     const Visibility& model_visibility,
                     int code_offset,
                     const fs::path& folder) {
  const auto seed = [&](const char* purpose) { return SeedFor(recipe.seed, purpose, index); };
  ImageF picture = DevelopPhotograph(RenderRadiance(scene, plan.camera, seed("rays")),
                                     plan.camera,
                                     plan.photometry,
                                     seed("grain"));
  DrawDust(plan.num_specks, plan.num_scratches, seed("dust"), picture);
  const Image16 model_labels = model_visibility.FaceLabels(plan.written_camera);
  Image16 occluded =
      OccludedLabels(scene.world, scene.visibility, plan.written_camera, model_labels, code_offset);
  if (recipe.slide.mount_margin > 0) {
    const MountOpening opening{recipe.slide.mount_margin * recipe.width_px};
    DrawMount(opening, plan.slide, picture);
    MarkMount(opening, plan, kMount + code_offset, occluded);
  }
  if (recipe.photo.ntsc) picture = NtscFromScan(picture, seed("video"));
  const fs::path truth = folder / "truth";
  WriteLabels(truth / "masks_model" / (plan.name + ".png"), model_labels);
  WriteLabels(truth / "masks_occ" / (plan.name + ".png"), occluded);
  const fs::path file = folder / "images" / PictureFileName(plan, recipe);
  if (recipe.photo.bits == 8) {
    WriteSrgb8(file, QuantiseSrgb8(picture));
    return;
  }
  // The writer encodes what is linear, and so back to the scan's own values.
  std::transform(
      picture.values.begin(), picture.values.end(), picture.values.begin(), LinearFromSrgb);
  WriteRadiance(file, picture, {.bits = 16});
}

// Clean, exact and overcast, with nothing in the way.
void WriteNovelView(const SynthRecipe& recipe,
                    const PlannedView& view,
                    const RayScene& scene,
                    const Visibility& model_visibility,
                    const fs::path& folder) {
  ViewTag tag;
  tag.position_in_site = view.position_in_site;
  tag.lookat_in_site = view.lookat_in_site;
  tag.view_angle_deg = view.view_angle_deg;
  tag.aspect = static_cast<double>(recipe.width_px) / recipe.height_px;
  const Camera camera = CameraFromTag(tag, recipe.width_px, recipe.height_px);
  WriteFileAtomically(
      folder / (view.name + ".view"),
      FormatView(tag, ViewComment(view.name, "Held out: exact, and no slide errors")));
  WriteSrgb8(folder / (view.name + ".png"),
             QuantiseSrgb8(
                 DevelopPhotograph(RenderRadiance(scene, camera, SeedFor(recipe.seed, view.name)),
                                   camera,
                                   Photometry(),
                                   0)));
  WriteLabels(folder / (view.name + "_faces.png"), model_visibility.FaceLabels(camera));
}

OccluderSite SiteOf(const PlannedScene& planned) {
  const Box& bounds = planned.built;
  OccluderSite site;
  for (size_t face = 0; face < planned.world.surfaces.size(); ++face) {
    if (planned.world.geometry.faces[face].name != kPlazaName) continue;
    const Surface& plaza = planned.world.surfaces[face];
    site.plaza_low = {plaza.low_u, plaza.low_v};
    site.plaza_high = {plaza.high_u, plaza.high_v};
  }
  site.low = bounds.min.head<2>();
  site.high = bounds.max.head<2>();
  site.radius = (site.high - site.low).maxCoeff() / 2 + 75;
  for (const PhotographPlan& plan : planned.photographs) {
    site.camera_positions.push_back(plan.camera.PositionInWorld());
  }
  return site;
}

void WriteDocuments(const SynthRecipe& recipe,
                    const PlannedScene& planned,
                    const fs::path& folder) {
  const PolygonModel& model = planned.model;
  const std::vector<PhotographPlan>& plans = planned.photographs;
  WriteFileAtomically(folder / "model.osu", FormatOsu(model));
  WriteFileAtomically(folder / "recipe.json", FormatRecipe(recipe));
  WriteFileAtomically(folder / "truth" / "truth.json", FormatTruth(recipe, planned));
  if (planned.exact_model) {
    WriteFileAtomically(folder / "truth" / "model_exact.osu", FormatOsu(*planned.exact_model));
  }
  if (!planned.wall_tags.empty()) {
    const auto table = [&](bool is_truth) {
      return FormatWallTags(planned.wall_tags, recipe.april_tags, is_truth);
    };
    WriteFileAtomically(folder / "apriltags.csv", table(false));
    WriteFileAtomically(folder / "truth" / "apriltags.csv", table(true));
  }
  std::vector<NamedCamera> cameras;
  for (const PhotographPlan& plan : plans) {
    cameras.push_back({PictureFileName(plan, recipe), plan.written_camera});
    WriteFileAtomically(folder / "views" / (plan.name + ".view"),
                        FormatView(plan.entry.measured, ViewComment(plan.name, plan.comment)));
  }
  WriteColmapModel(folder / "truth" / "cameras", cameras);
}

}  // namespace

SynthSummary WriteSyntheticScene(const SynthRecipe& recipe,
                                 const fs::path& folder,
                                 const Progress& progress) {
  recipe.Check();
  CheckFolderIsFree(folder);
  const PlannedScene planned = PlanScene(recipe);
  const PolygonModel& model = planned.model;
  const std::vector<PhotographPlan>& plans = planned.photographs;
  SynthSummary summary;
  summary.num_faces = static_cast<int>(model.faces.size());
  summary.num_photographs = static_cast<int>(plans.size());
  summary.num_april_tags = static_cast<int>(planned.wall_tags.size());
  summary.num_novel_views = static_cast<int>(planned.novel_views.size());
  for (const PhotographPlan& plan : plans) {
    summary.num_blunders += plan.blunder != Blunder::kNone;
    if (plan.blunder == Blunder::kNone) {
      summary.mean_tag_error_px += MeasureTagError(model, plan).mean_px;
    }
  }
  summary.mean_tag_error_px /= std::max(1, summary.num_photographs - summary.num_blunders);
  WriteDocuments(recipe, planned, folder);

  const Visibility model_visibility(model);
  const Visibility clean_visibility(planned.world.geometry);
  const Box bounds = ComputeBounds(model);
  const SkyMap sky_map(planned.world, clean_visibility, bounds.Center(), 1.5 * bounds.Diagonal());
  const Daylight overcast = MakeOvercast(SeedFor(recipe.seed, "novel"));
  WriteSurfaces(folder / "truth" / "surfaces",
                planned.world,
                model,
                clean_visibility,
                sky_map,
                overcast,
                {.texel = recipe.surface_texel});
  const OccluderSite site = SiteOf(planned);
  SyntheticWorld furnished = planned.world;
  WorldBuilder furnisher(furnished, SeedFor(recipe.seed, "occluders"));
  AddStandingOccluders(furnisher, site, recipe.occluders, recipe.seed);

  ProgressCounter steps(progress, summary.num_photographs + summary.num_novel_views);
  for (size_t i = 0; i < plans.size(); ++i) {
    const PhotographPlan& plan = plans[i];
    SyntheticWorld world = furnished;
    WorldBuilder builder(world, SeedFor(recipe.seed, "passing", i));
    AddPassingOccluders(builder,
                        site,
                        plan.camera.PositionInWorld(),
                        plan.camera.ForwardInWorld(),
                        recipe.occluders,
                        SeedFor(recipe.seed, "passing", i));
    const Visibility visibility(world.geometry);
    WritePhotograph(recipe,
                    plan,
                    static_cast<int>(i),
                    {world, visibility, sky_map, plan.light, recipe.photo.edge_rays},
                    model_visibility,
                    OccluderCodeOffset(model),
                    folder);
    steps.Tell(plan.name);
  }
  for (const PlannedView& view : planned.novel_views) {
    WriteNovelView(recipe,
                   view,
                   {planned.world, clean_visibility, sky_map, overcast, recipe.photo.edge_rays},
                   model_visibility,
                   folder / "truth" / "novel");
    steps.Tell(view.name);
  }
  return summary;
}

Image8 RenderPresetPicture(const SynthRecipe& recipe) {
  recipe.Check();
  const PlannedScene planned = PlanScene(recipe);
  const PhotographPlan& plan = planned.photographs.front();
  const Visibility visibility(planned.world.geometry);
  const Box bounds = ComputeBounds(planned.model);
  const SkyMap sky_map(planned.world, visibility, bounds.Center(), 1.5 * bounds.Diagonal());
  SyntheticWorld world = planned.world;
  WorldBuilder builder(world, SeedFor(recipe.seed, "occluders"));
  AddStandingOccluders(builder, SiteOf(planned), recipe.occluders, recipe.seed);
  const Visibility furnished(world.geometry);
  ImageF picture =
      DevelopPhotograph(RenderRadiance({world, furnished, sky_map, plan.light}, plan.camera, 1),
                        plan.camera,
                        plan.photometry,
                        2);
  if (recipe.photo.ntsc) picture = NtscFromScan(picture, 3);
  return QuantiseSrgb8(picture);
}

}  // namespace groundglass
