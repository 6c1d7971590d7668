// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// What a building of the preset `random` is like; its corners and windows then follow from the
// seed. Lengths in feet.
struct RandomTraits {
  std::string plan = "rectangle";  // L, T, U, courtyard, tower, wings
  double width = 60;               // along the street
  double depth = 40;
  int storeys = 3;
  double storey_height = 11;
  int setbacks = 0;           // upper storeys that stand back, under flat roofs
  double corner_radius = 0;   // of the street's corners, under flat roofs
  std::string roof = "flat";  // gabled, hipped, mono
  double pitch = 0.8;         // rise over run
  double overhang = 1;        // of pitched roofs
  double parapet = 2;         // of flat ones
  int chimneys = 0;
  int dormers = 0;
  std::string cladding = "brick";  // stone, plaster, tile, concrete, glass
  std::string windows = "grid";    // pairs, bands, irregular, single
  double bay = 9;
  double window_width = 3.5;
  double window_height = 5;
  double blind_share = 0.2;  // of the walls that are not on the street
  double recess = 0.4;       // of windows behind the wall
  bool has_arches = false;
  bool has_sills = true;
  double cornice = 0;  // how far it stands out; 0: none
  bool has_courses = false;
  bool has_plinth = false;
  int steps = 2;  // before the door
  bool has_porch = false;
  std::string neighbours = "none";  // left, right, both
  double heading_deg = 0;           // the plan's turn, counterclockwise seen from above
  std::string ground = "paving";    // grass, asphalt
  // Each photograph's angle is drawn between them; a lens that does not zoom has them alike.
  double view_angle_low_deg = 50;
  double view_angle_high_deg = 50;

  // What people get of it.
  struct Model {
    // massing: no windows; openings: windows in the wall's plane; recesses: windows as deep as they
    // are, cornices, sills; mullions: openings parted into panes.
    std::string detail = "openings";
    double sigma = 0.1;        // of plan lines, levels and windows' sides
    double stated_sigma = 0;   // what its file says of that; 0: nothing
    double wall_off = 0;       // one plan line, beyond that
    double eaves_off = 0;      // the main body's eaves, likewise
    double windows_off = 0;    // the windows of one wall, along it
    bool has_overhang = true;  // else roofs end at the walls
    bool has_parapet = true;   // else flat roofs lie at the walls' top
    bool has_neighbours = false;
    // Some of chimneys, dormers, steps, porch, parted by blanks.
    std::string omits;
  } model;

  void Check() const;  // throws Error naming the first field out of range
};

}  // namespace groundglass
