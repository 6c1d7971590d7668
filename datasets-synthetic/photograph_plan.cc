// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/photograph_plan.h"

#include "datasets-synthetic/noise.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

std::string PictureFileName(const PhotographPlan& plan, const SynthRecipe& recipe) {
  return plan.name + (recipe.photo.bits == 16 ? ".tif" : ".jpg");
}

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
  plan.written_camera = recipe.photo.ntsc ? ResizedCamera(plan.camera, 640, 480) : plan.camera;

  plan.num_specks = static_cast<int>(2 * recipe.slide.specks * UniformOf(HashOf(slide_seed, 5)));
  plan.num_scratches =
      static_cast<int>(std::lround(2 * recipe.slide.scratches * UniformOf(HashOf(slide_seed, 6))));

  const uint64_t photo_seed = SeedFor(recipe.seed, "photo", index);
  const auto photo_normal = [&](int which) { return NormalOf(HashOf(photo_seed, which)); };
  plan.photometry.exposure_stops = recipe.photo.sigma_exposure_stops * photo_normal(0);
  plan.photometry.white_balance = {std::exp(recipe.photo.sigma_white_balance * photo_normal(1)),
                                   1,
                                   std::exp(recipe.photo.sigma_white_balance * photo_normal(2))};
  plan.photometry.vignetting = recipe.photo.max_vignetting * UniformOf(HashOf(photo_seed, 3));
  plan.photometry.grain = recipe.photo.grain * (0.7 + 0.6 * UniformOf(HashOf(photo_seed, 4)));
  plan.photometry.blur_px = recipe.photo.blur_px * (0.8 + 0.4 * UniformOf(HashOf(photo_seed, 5)));

  const double unit_px = recipe.width_px / 1500.0;
  if (UniformOf(HashOf(photo_seed, 6)) < recipe.photo.spoilt_share) {
    const double strength = unit_px * (0.6 + 0.8 * UniformOf(HashOf(photo_seed, 7)));
    if (UniformOf(HashOf(photo_seed, 8)) < 0.5) {
      plan.photometry.motion_px = strength * recipe.photo.motion_px;
      plan.photometry.motion_deg = 180 * UniformOf(HashOf(photo_seed, 9));
    } else {
      plan.photometry.defocus_px = strength * recipe.photo.defocus_px;
    }
  }

  const uint64_t light_seed = SeedFor(recipe.seed, "light", index);
  const std::string& lights = recipe.photo.light;
  const bool is_sunny = lights.empty() ? UniformOf(HashOf(light_seed, 0)) < recipe.photo.sunny_share
                                       : lights[static_cast<size_t>(index) % lights.size()] == 's';
  if (is_sunny) {
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

}  // namespace groundglass
