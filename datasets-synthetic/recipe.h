// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/occluders.h"
#include "datasets-synthetic/random/traits.h"

#include <cstdint>
#include <string>
#include <vector>

namespace groundglass {

// Everything that a synthetic scene is made from. The same recipe and build give the same bytes.
struct SynthRecipe {
  std::string preset = "wiesner";
  std::string building = "wiesner";  // or brick, cityblock, random
  RandomTraits random;               // of a random building
  int num_faces = 1000;              // of a city block, about
  int width_px = 1500;
  int height_px = 1000;
  // How many of the building's planned views are taken; 0 for all.
  int num_views = 0;
  // How deep the photographed building's windows lie, and whether its rounded corners are round,
  // which the model leaves out; 1: as the building is, 0: the building is its model.
  double relief = 1;
  // Every face in one even colour: nothing but the model's own edges.
  bool is_plain = false;
  // How wide the texels of truth/surfaces are, in the model's unit: about what a slide resolves
  // from across a plaza.
  double surface_texel = 0.125;
  uint64_t seed = 1988;

  // The notebook: one standard deviation of what was measured, and what a tape resolves, in the
  // model's unit. Roll is never written down; the true one has sigma_roll_deg.
  struct Notebook {
    double sigma_position = 0.15;
    double sigma_height = 0.05;
    double sigma_lookat = 0.3;
    double sigma_roll_deg = 0.3;
    double tape = 0.1;
    // How many of the tags hold a blunder: swapped coordinates, a wrong sign, another photograph's
    // numbers. Marked in truth.json.
    int blunders = 0;
    // The errors are this many times as large as the sigmas, of which the writer knows nothing.
    double error_scale = 1;
    // What the tags say of their own errors, in the sigmas above; 0: nothing.
    double stated_scale = 0;
  } notebook;

  // Mount and scanner, one standard deviation each.
  struct Slide {
    double sigma_shift = 0.01;  // of the width, each way
    double sigma_turn_deg = 0.7;
    double sigma_scale = 0.01;
    double sigma_anisotropy = 0.003;
    // How far the mount's opening reaches beyond the frame, of the width; 0: no mount is seen.
    double mount_margin = 0;
    double specks = 4;  // of dust, mean for a slide
    double scratches = 0.3;
  } slide;

  // The lens, the same for all photographs.
  struct Lens {
    double k1 = 0;
    // The focal length over the one that was written down.
    double focal_scale = 1;
    // What the tags call it; empty: they do not say that it is one lens.
    std::string name;
  } lens;

  struct Photo {
    double sunny_share = 0.5;
    double sigma_exposure_stops = 0.25;
    double sigma_white_balance = 0.03;
    double max_vignetting = 0.8;
    double grain = 0.012;
    double blur_px = 0.6;
    // How many of the photographs were shaken or out of focus, half and half; how far a point
    // travels, and the radius that it spreads to, in pixels at 1500 wide.
    double spoilt_share = 0.12;
    double motion_px = 5;
    double defocus_px = 2.5;
    // Digitised as an NTSC frame, 640 x 480 whatever the size of the scan.
    bool ntsc = false;
    // Rays through a pixel where faces or shadows meet, a square number: 16 place an edge to a few
    // hundredths of a pixel.
    int edge_rays = 16;
    // 8: JPEG; 16: TIFF with 16 bits.
    int bits = 8;
    // The light of each photograph in turn: s for sun, o for overcast; empty for chance.
    std::string light;
  } photo;

  // AprilTags (tag36h11) on the building's walls, with their survey in apriltags.csv.
  struct AprilTags {
    int count = 0;
    double size = 3;      // of the black square, in the model's unit
    double sigma = 0.03;  // of the survey along each axis, one standard deviation; model's unit
    // A tag hangs only where a photograph shows its black square this large; pixels, the side of
    // the square of the same area.
    double least_px = 24;
  } april_tags;

  // What stands in the way and is not in the model.
  OccluderCounts occluders;

  void Check() const;  // throws Error naming the first field out of range
};

struct SynthPreset {
  std::string name;
  std::string description;
};
std::vector<SynthPreset> ListSynthPresets();

// Throws Error naming the presets there are, if there is no such preset.
SynthRecipe PresetRecipe(const std::string& preset);

// Overrides fields by a JSON object laid out as FormatRecipe writes it; fields that are not there
// stay. `name` stands for the file in messages. Throws Error naming an unknown or wrong field.
void ApplyRecipeJson(const std::string& json, const std::string& name, SynthRecipe& recipe);
std::string FormatRecipe(const SynthRecipe& recipe);

}  // namespace groundglass
