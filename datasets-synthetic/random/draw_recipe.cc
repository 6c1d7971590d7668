// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/draw_recipe.h"

#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/occluder_shapes.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

struct Choice {
  const char* name;
  double weight;
};

std::string Pick(Draws& draws, const std::vector<Choice>& choices) {
  double sum = 0;
  for (const Choice& choice : choices) sum += choice.weight;
  double left = draws.Uniform(0, sum);
  for (const Choice& choice : choices) {
    left -= choice.weight;
    if (left < 0) return choice.name;
  }
  return choices.back().name;
}

// To so many units: what is drawn is read by people in recipe.json.
double Rounded(double value, double unit) { return unit * std::round(value / unit); }

double Within(Draws& draws, double low, double high, double unit) {
  return Rounded(draws.Uniform(low, high), unit);
}

int Between(Draws& draws, int low, int high) {
  return low + static_cast<int>(draws.Uniform(0, high - low + 1));
}

void DrawMasses(Draws& draws, RandomTraits& traits) {
  traits.plan = Pick(draws,
                     {{"rectangle", 3},
                      {"L", 2},
                      {"T", 1.5},
                      {"U", 1.2},
                      {"courtyard", 0.8},
                      {"tower", 1.5},
                      {"wings", 2}});
  traits.roof = Pick(draws, {{"flat", 5}, {"gabled", 3}, {"hipped", 2}, {"mono", 0.8}});
  if (traits.plan == "courtyard") traits.roof = "flat";
  const bool is_flat = traits.roof == "flat";
  traits.width = Within(draws, 34, 100, 0.25);
  traits.depth = Within(draws, 28, is_flat ? 70 : 48, 0.25);
  if (traits.plan == "courtyard" || traits.plan == "U") {
    traits.width = std::max(traits.width, 72 + Within(draws, 0, 30, 0.25));
    if (is_flat) traits.depth = std::max(traits.depth, 62 + Within(draws, 0, 20, 0.25));
  }
  traits.storeys = Between(draws, 1, is_flat ? 7 : 4);
  traits.storey_height = Within(draws, 9.5, 14, 0.1);
  if (is_flat && traits.plan == "rectangle" && draws.Chance(0.25)) traits.storeys += 5;
  if (is_flat && traits.storeys > 1) {
    traits.setbacks = Pick(draws, {{"0", 3}, {"1", 2}, {"2", 1}})[0] - '0';
  }
  if (is_flat && draws.Chance(0.25)) traits.corner_radius = Within(draws, 3, 9, 0.5);
  traits.pitch = Within(draws, 0.45, 1.15, 0.01);
  if (traits.roof == "mono") traits.pitch = Within(draws, 0.1, 0.25, 0.01);
  traits.overhang = draws.Chance(0.25) ? 0 : Within(draws, 0.5, 2, 0.1);
  traits.parapet = draws.Chance(0.3) ? 0 : Within(draws, 1, 3.5, 0.1);
  traits.chimneys = is_flat ? 0 : Between(draws, 0, 2);
  if (!is_flat && traits.roof != "mono" && draws.Chance(0.4)) traits.dormers = Between(draws, 1, 3);
}

void DrawWalls(Draws& draws, RandomTraits& traits) {
  const bool is_flat = traits.roof == "flat";
  traits.cladding = Pick(draws,
                         {{"brick", 3},
                          {"stone", 2},
                          {"plaster", 3},
                          {"tile", is_flat ? 1.0 : 0.0},
                          {"concrete", is_flat ? 1.5 : 0.0},
                          {"glass", is_flat && traits.storeys > 2 ? 1.0 : 0.0}});
  traits.windows =
      Pick(draws, {{"grid", 4}, {"pairs", 1.5}, {"bands", 1.2}, {"irregular", 1.5}, {"single", 1}});
  if (traits.cladding == "glass") traits.windows = "bands";
  traits.bay = Within(draws, 6.5, 14, 0.1);
  traits.window_width = Rounded(traits.bay * draws.Uniform(0.3, 0.6), 0.1);
  traits.window_height = Rounded(traits.storey_height * draws.Uniform(0.35, 0.58), 0.1);
  traits.blind_share = Within(draws, 0, 0.5, 0.05);
  traits.recess = draws.Chance(0.15) ? 0 : Within(draws, 0.1, 1, 0.05);
  const bool is_masonry =
      traits.cladding == "brick" || traits.cladding == "stone" || traits.cladding == "plaster";
  traits.has_arches = is_masonry && traits.windows != "bands" && draws.Chance(0.3);
  traits.has_sills = traits.cladding != "glass" && draws.Chance(0.7);
  traits.cornice = is_masonry && is_flat && draws.Chance(0.6) ? Within(draws, 0.4, 1.6, 0.1) : 0;
  traits.has_courses = is_masonry && traits.storeys > 1 && draws.Chance(0.4);
  traits.has_plinth = is_masonry && draws.Chance(0.5);
  traits.steps = Between(draws, 0, 5);
  traits.has_porch = draws.Chance(0.25);
  traits.neighbours = Pick(draws, {{"none", 3}, {"left", 1}, {"right", 1}, {"both", 1.2}});
  traits.heading_deg = draws.Chance(0.3) ? 0 : Within(draws, -180, 180, 0.5);
  traits.ground = Pick(draws, {{"paving", 2}, {"grass", 1.5}, {"asphalt", 1}});
}

void DrawModel(Draws& draws, RandomTraits& traits) {
  RandomTraits::Model& model = traits.model;
  model.detail =
      Pick(draws, {{"massing", 1.5}, {"openings", 3}, {"recesses", 1.5}, {"mullions", 1}});
  model.sigma = Within(draws, 0, 0.25, 0.005);
  if (draws.Chance(0.3)) {
    model.stated_sigma = std::max(0.02, Rounded(model.sigma * draws.Uniform(0.6, 1.3), 0.01));
  }
  const auto foot = [&] {
    const double sign = draws.Chance(0.5) ? 1 : -1;
    return sign * Within(draws, 0.6, 1.2, 0.05);
  };
  if (draws.Chance(0.2)) model.wall_off = foot();
  if (draws.Chance(0.2)) model.eaves_off = foot();
  if (draws.Chance(0.15)) model.windows_off = foot();
  model.has_overhang = model.detail != "massing" && draws.Chance(0.6);
  model.has_parapet = model.detail != "massing" && draws.Chance(0.6);
  model.has_neighbours = traits.neighbours != "none" && draws.Chance(0.4);
  const double omits = model.detail == "massing" ? 0.6 : 0.2;
  for (const char* part : {"chimneys", "dormers", "steps", "porch"}) {
    if (draws.Chance(omits)) model.omits += (model.omits.empty() ? "" : " ") + std::string(part);
  }
}

void DrawNotebook(Draws& draws, SynthRecipe& recipe) {
  SynthRecipe::Notebook& notebook = recipe.notebook;
  const double care = std::exp(draws.Uniform(std::log(0.5), std::log(4)));
  notebook.sigma_position = Rounded(care * draws.Uniform(0.1, 0.25), 0.01);
  notebook.sigma_height = Rounded(care * draws.Uniform(0.04, 0.12), 0.01);
  notebook.sigma_lookat = Rounded(care * draws.Uniform(0.2, 0.5), 0.01);
  notebook.tape = draws.Chance(0.5) ? 0.1 : 0.25;
  notebook.error_scale = draws.Chance(1.0 / 3) ? Within(draws, 1.5, 3, 0.1) : 1;
  if (draws.Chance(0.4)) {
    notebook.stated_scale = draws.Chance(0.3) ? Within(draws, 0.4, 0.8, 0.05) : 1;
  }
}

void DrawCamera(Draws& draws, SynthRecipe& recipe) {
  const bool is_digital = draws.Chance(0.5);
  RandomTraits& traits = recipe.random;
  traits.view_angle_low_deg = Within(draws, 25, 75, 0.5);
  traits.view_angle_high_deg = traits.view_angle_low_deg;
  if (is_digital) {
    // Held by hand, and the same lens: no mount, no scan.
    recipe.slide = {0, 0, 0, 0, 0, 0, 0};
    recipe.notebook.sigma_roll_deg = Within(draws, 0.3, 1.8, 0.1);
    recipe.lens.focal_scale = Rounded(1 + 0.008 * draws.Normal(), 0.0005);
    if (draws.Chance(0.5)) recipe.lens.name = "camera1";
    recipe.photo.grain = Within(draws, 0.003, 0.01, 0.001);
  } else {
    if (draws.Chance(0.3)) {
      traits.view_angle_high_deg =
          std::min(75.0, traits.view_angle_low_deg + Within(draws, 5, 25, 0.5));
    }
    recipe.notebook.sigma_roll_deg = Within(draws, 0.1, 1, 0.1);
    const bool is_soiled = draws.Chance(0.3);
    recipe.slide.mount_margin = is_soiled ? 0.006 : 0;
    recipe.slide.specks = is_soiled ? Within(draws, 10, 40, 1) : Within(draws, 0, 6, 1);
    recipe.slide.scratches = is_soiled ? Within(draws, 0.5, 3, 0.5) : 0.3;
    recipe.photo.grain = Within(draws, 0.006, 0.022, 0.001);
  }
  recipe.lens.k1 = draws.Chance(0.3) ? 0 : Within(draws, -0.15, 0.05, 0.005);
  // Wide lenses bend most.
  if (traits.view_angle_high_deg < 40) recipe.lens.k1 = Rounded(recipe.lens.k1 / 2, 0.005);
  recipe.photo.sigma_exposure_stops = Within(draws, 0.1, 0.4, 0.05);
  recipe.photo.blur_px = Within(draws, 0.4, 0.9, 0.05);
  recipe.photo.spoilt_share = Within(draws, 0, 0.2, 0.05);
  const std::string light = Pick(draws, {{"sun", 1}, {"overcast", 1}, {"mixed", 1}});
  recipe.photo.sunny_share = light == "sun" ? 1 : light == "overcast" ? 0 : 0.5;
}

}  // namespace

SynthRecipe DrawRandomRecipe(uint64_t seed) {
  SynthRecipe recipe;
  recipe.preset = recipe.building = "random";
  recipe.seed = seed;
  recipe.width_px = 640;
  recipe.height_px = 427;
  recipe.num_views = 8;
  recipe.surface_texel = 0.5;
  recipe.photo.edge_rays = 9;
  // Each purpose draws from a seed of its own, so that more draws of one do not change the others.
  Draws masses(SeedFor(seed, "random masses"));
  DrawMasses(masses, recipe.random);
  Draws walls(SeedFor(seed, "random walls"));
  DrawWalls(walls, recipe.random);
  Draws model(SeedFor(seed, "random model"));
  DrawModel(model, recipe.random);
  Draws notebook(SeedFor(seed, "random notebook"));
  DrawNotebook(notebook, recipe);
  Draws camera(SeedFor(seed, "random camera"));
  DrawCamera(camera, recipe);
  Draws things(SeedFor(seed, "random things"));
  recipe.occluders = {.trees = Between(things, 0, 4),
                      .lamps = Between(things, 0, 5),
                      .signs = Between(things, 0, 2),
                      .cars = Within(things, 0, 1.5, 0.1),
                      .people = Within(things, 0, 2, 0.1)};
  return recipe;
}

}  // namespace groundglass
