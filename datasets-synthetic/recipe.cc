// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/recipe.h"

#include "datasets-synthetic/random/draw_recipe.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/json_fault.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

template <typename Traits, typename Visit>
void VisitTraits(Traits& traits, const Visit& visit) {
  visit("random/plan", traits.plan);
  visit("random/width", traits.width);
  visit("random/depth", traits.depth);
  visit("random/storeys", traits.storeys);
  visit("random/storey_height", traits.storey_height);
  visit("random/setbacks", traits.setbacks);
  visit("random/corner_radius", traits.corner_radius);
  visit("random/roof", traits.roof);
  visit("random/pitch", traits.pitch);
  visit("random/overhang", traits.overhang);
  visit("random/parapet", traits.parapet);
  visit("random/chimneys", traits.chimneys);
  visit("random/dormers", traits.dormers);
  visit("random/cladding", traits.cladding);
  visit("random/windows", traits.windows);
  visit("random/bay", traits.bay);
  visit("random/window_width", traits.window_width);
  visit("random/window_height", traits.window_height);
  visit("random/blind_share", traits.blind_share);
  visit("random/recess", traits.recess);
  visit("random/arches", traits.has_arches);
  visit("random/sills", traits.has_sills);
  visit("random/cornice", traits.cornice);
  visit("random/courses", traits.has_courses);
  visit("random/plinth", traits.has_plinth);
  visit("random/steps", traits.steps);
  visit("random/porch", traits.has_porch);
  visit("random/neighbours", traits.neighbours);
  visit("random/heading_deg", traits.heading_deg);
  visit("random/ground", traits.ground);
  visit("random/view_angle_low_deg", traits.view_angle_low_deg);
  visit("random/view_angle_high_deg", traits.view_angle_high_deg);
  visit("random/model/detail", traits.model.detail);
  visit("random/model/sigma", traits.model.sigma);
  visit("random/model/stated_sigma", traits.model.stated_sigma);
  visit("random/model/wall_off", traits.model.wall_off);
  visit("random/model/eaves_off", traits.model.eaves_off);
  visit("random/model/windows_off", traits.model.windows_off);
  visit("random/model/overhang", traits.model.has_overhang);
  visit("random/model/parapet", traits.model.has_parapet);
  visit("random/model/neighbours", traits.model.has_neighbours);
  visit("random/model/omits", traits.model.omits);
}

// Calls `visit` with the path and the value of each field, so that reading, writing and checking
// agree on what there is.
template <typename Recipe, typename Visit>
void VisitFields(Recipe& recipe, const Visit& visit) {
  visit("building", recipe.building);
  visit("faces", recipe.num_faces);
  visit("width", recipe.width_px);
  visit("height", recipe.height_px);
  visit("views", recipe.num_views);
  visit("seed", recipe.seed);
  visit("relief", recipe.relief);
  visit("plain", recipe.is_plain);
  visit("surface_texel", recipe.surface_texel);
  visit("notebook/sigma_position", recipe.notebook.sigma_position);
  visit("notebook/sigma_height", recipe.notebook.sigma_height);
  visit("notebook/sigma_lookat", recipe.notebook.sigma_lookat);
  visit("notebook/sigma_roll_deg", recipe.notebook.sigma_roll_deg);
  visit("notebook/tape", recipe.notebook.tape);
  visit("notebook/blunders", recipe.notebook.blunders);
  visit("notebook/error_scale", recipe.notebook.error_scale);
  visit("notebook/stated_scale", recipe.notebook.stated_scale);
  visit("slide/sigma_shift", recipe.slide.sigma_shift);
  visit("slide/sigma_turn_deg", recipe.slide.sigma_turn_deg);
  visit("slide/sigma_scale", recipe.slide.sigma_scale);
  visit("slide/sigma_anisotropy", recipe.slide.sigma_anisotropy);
  visit("slide/mount_margin", recipe.slide.mount_margin);
  visit("slide/specks", recipe.slide.specks);
  visit("slide/scratches", recipe.slide.scratches);
  visit("lens/k1", recipe.lens.k1);
  visit("lens/focal_scale", recipe.lens.focal_scale);
  visit("lens/name", recipe.lens.name);
  visit("photo/sunny_share", recipe.photo.sunny_share);
  visit("photo/sigma_exposure_stops", recipe.photo.sigma_exposure_stops);
  visit("photo/sigma_white_balance", recipe.photo.sigma_white_balance);
  visit("photo/max_vignetting", recipe.photo.max_vignetting);
  visit("photo/grain", recipe.photo.grain);
  visit("photo/blur_px", recipe.photo.blur_px);
  visit("photo/spoilt_share", recipe.photo.spoilt_share);
  visit("photo/motion_px", recipe.photo.motion_px);
  visit("photo/defocus_px", recipe.photo.defocus_px);
  visit("photo/ntsc", recipe.photo.ntsc);
  visit("photo/edge_rays", recipe.photo.edge_rays);
  visit("photo/bits", recipe.photo.bits);
  visit("photo/light", recipe.photo.light);
  visit("april_tags/count", recipe.april_tags.count);
  visit("april_tags/size", recipe.april_tags.size);
  visit("april_tags/sigma", recipe.april_tags.sigma);
  visit("april_tags/least_px", recipe.april_tags.least_px);
  visit("occluders/trees", recipe.occluders.trees);
  visit("occluders/lamps", recipe.occluders.lamps);
  visit("occluders/signs", recipe.occluders.signs);
  visit("occluders/cars", recipe.occluders.cars);
  visit("occluders/people", recipe.occluders.people);
  if (recipe.building == "random") VisitTraits(recipe.random, visit);
}

bool MayBeNegative(const std::string& path) {
  return path == "lens/k1" || path == "random/heading_deg" || path.ends_with("_off");
}

Json::json_pointer Pointer(const std::string& path) { return Json::json_pointer("/" + path); }

}  // namespace

void SynthRecipe::Check() const {
  if (width_px < 16 || height_px < 16 || width_px > 20000 || height_px > 20000) {
    throw OptionError("recipe fields width and height:",
                      "a synthetic picture must be 16 to 20000 px each way, not " +
                          std::to_string(width_px) + "x" + std::to_string(height_px));
  }
  VisitFields(*this, [](const std::string& path, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      if (!std::isfinite(value)) throw Error("recipe field " + path + " must be a finite number");
      if (!MayBeNegative(path) && value < 0) {
        throw Error("recipe field " + path + " must not be negative");
      }
    }
  });
  if (building != "wiesner" && building != "brick" && building != "cityblock" &&
      building != "random") {
    throw Error("recipe field building must be wiesner, brick, cityblock or random, not " +
                building);
  }
  if (building == "random") random.Check();
  CheckAbove(notebook.error_scale, 0, "recipe field notebook/error_scale");
  CheckAbove(lens.focal_scale, 0, "recipe field lens/focal_scale");
  if (num_faces < 300 || num_faces > 30000) {
    throw Error("recipe field faces must be 300 to 30000");
  }
  if (num_views < 0) throw Error("recipe field views must not be negative");
  if (relief > 2) throw Error("recipe field relief must be at most 2");
  if (surface_texel < 0.03 || surface_texel > 10) {
    throw Error("recipe field surface_texel must be 0.03 to 10");
  }
  if (notebook.blunders < 0) throw Error("recipe field notebook/blunders must not be negative");
  CheckFromTo(april_tags.count, 0, 100, "recipe field april_tags/count");
  CheckAbove(april_tags.size, 0, "recipe field april_tags/size");
  CheckAbove(april_tags.sigma, 0, "recipe field april_tags/sigma");
  if (photo.spoilt_share > 1) throw Error("recipe field photo/spoilt_share must be at most 1");
  if (photo.bits != 8 && photo.bits != 16) throw Error("recipe field photo/bits must be 8 or 16");
  if (photo.edge_rays < 1 || photo.edge_rays > 1024) {
    throw Error("recipe field photo/edge_rays must be 1 to 1024");
  }
  if (photo.light.find_first_not_of("so") != std::string::npos) {
    throw Error("recipe field photo/light is made of s and o, for sun and overcast");
  }
  if (photo.sunny_share > 1) throw Error("recipe field photo/sunny_share must be at most 1");
  if (photo.max_vignetting > 1) throw Error("recipe field photo/max_vignetting must be at most 1");
}

std::vector<SynthPreset> ListSynthPresets() {
  return {
      {"wiesner", "white tiled modernist block, 88 faces, feet, 23 slides as the thesis took them"},
      {"pure", "the same building as its model is, without any nuisance: plain faces, exact tags"},
      {"ntsc", "wiesner digitised through NTSC video: 640x480, pixels that are not square"},
      {"brick", "gabled brick hall with stone trim and slate roofs, 16 slides"},
      {"cityblock", "six buildings with every window in the model, 1,000 faces, 22 slides"},
      {"random", "a building of its own for each seed, with neighbours, model errors, any lens"},
      {"hard", "wiesner with everything at once: sun, trees, cars, mounts, dust, k1, exposure"},
  };
}

SynthRecipe PresetRecipe(const std::string& preset) {
  if (preset == "random") return DrawRandomRecipe(SynthRecipe().seed);
  SynthRecipe recipe;
  recipe.preset = preset;
  recipe.occluders = {.trees = 4, .lamps = 6, .signs = 2, .cars = 0.3, .people = 1.5};
  if (preset == "wiesner") return recipe;
  if (preset == "brick" || preset == "cityblock") {
    recipe.building = preset;
    // A city block shows scale: its model has every window, and it is what the model says.
    if (preset == "cityblock") recipe.relief = 0;
    return recipe;
  }
  if (preset == "ntsc") {
    recipe.photo.ntsc = true;
    return recipe;
  }
  if (preset == "hard") {
    recipe.slide.mount_margin = 0.006;
    recipe.slide.specks = 25;
    recipe.slide.scratches = 2;
    recipe.lens.k1 = -0.03;
    recipe.photo.sunny_share = 0.7;
    recipe.photo.sigma_exposure_stops = 0.4;
    recipe.photo.sigma_white_balance = 0.06;
    recipe.photo.max_vignetting = 1;
    recipe.photo.grain = 0.022;
    recipe.photo.blur_px = 0.9;
    recipe.photo.spoilt_share = 0.3;
    recipe.occluders = {.trees = 9, .lamps = 12, .signs = 5, .cars = 2, .people = 4};
    return recipe;
  }
  if (preset == "pure") {
    recipe.relief = 0;
    recipe.is_plain = true;
    recipe.slide = {0, 0, 0, 0, 0, 0, 0};
    recipe.notebook = {0, 0, 0, 0, 0, 0};
    recipe.photo = {0, 0, 0, 0, 0, 0, 0, 0, 0, false, 100, 8, ""};
    recipe.occluders = {};
    return recipe;
  }
  std::string names;
  for (const SynthPreset& known : ListSynthPresets()) {
    names += (names.empty() ? "" : ", ") + known.name;
  }
  throw Error("no synthetic scene is called " + preset + "; there are " + names);
}

void ApplyRecipeJson(const std::string& text, const std::string& name, SynthRecipe& recipe) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(name, "is not JSON: " + TellJsonFault(error.what()));
  }
  if (!json.is_object()) throw Error(name, "a recipe is a JSON object");
  if (json.empty()) return;
  Json flat = json.flatten();
  VisitFields(recipe, [&](const std::string& path, auto& value) {
    if (!json.contains(Pointer(path))) return;
    try {
      json.at(Pointer(path)).get_to(value);
    } catch (const Json::exception&) {
      throw Error(name, "recipe field " + path + " is not of the kind expected");
    }
    flat.erase("/" + path);
  });
  flat.erase("/preset");
  if (!flat.empty()) throw Error(name, "unknown recipe field " + flat.begin().key().substr(1));
}

std::string FormatRecipe(const SynthRecipe& recipe) {
  Json json;
  json["preset"] = recipe.preset;
  VisitFields(recipe,
              [&](const std::string& path, const auto& value) { json[Pointer(path)] = value; });
  return json.dump(1) + "\n";
}

}  // namespace groundglass
