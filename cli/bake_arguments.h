// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake.h"
#include "invrender/tiles1988/tiles.h"
#include "pipeline/photograph_selection.h"
#include "pipeline/texture_stages.h"

#include <CLI/CLI.hpp>

#include <string>

namespace groundglass {

// What `invrender` and `run` share: the options of the texture.
struct BakeArguments {
  BakeOptions options;
  PhotographSelection selection;
  std::string format = "jpg";
  bool no_colour = false;
  bool no_consensus = false;
  bool tiles = false;
  bool tile_record = false;
  TileOptions tile_options;

  BakeOptions Options() const;
  TilesToWrite Tiles() const;
};
// `only_option` is what the option for faces is called: where --only means photographs, faces need
// another name.
void AddBakeArguments(CLI::App* command,
                      BakeArguments& arguments,
                      const std::string& only_option = "--only-faces");

// --tiles, --tile-record and what belongs to them.
void AddTileArguments(CLI::App* command, BakeArguments& arguments);

// Pictures and what is computed of them come and go. Without --memory, what they took stays with
// the program for what it needs next, since the system would clear the pages each time; with it, it
// goes back to the system.
void KeepFreedMemory(int max_memory_mb);

}  // namespace groundglass
