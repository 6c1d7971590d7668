// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake.h"
#include "invrender/bake_output.h"
#include "invrender/tiles1988/tiles.h"
#include "scene/formats/scene_folder.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What `invrender` and `run` share: the options of the texture.
struct BakeArguments {
  BakeOptions options;
  std::vector<std::string> exclude;  // photographs
  std::vector<std::string> only;     // faces
  std::optional<std::filesystem::path> masks_folder;
  std::string format = "jpg";
  bool accepted_only = false;
  bool no_colour = false;
  bool no_consensus = false;
  bool tiles = false;
  bool tile_record = false;
  TileOptions tile_options;

  BakeOptions Options() const;
};
// `only_option` is what the option for faces is called: where --only means photographs, faces need
// another name.
void AddBakeArguments(CLI::App* command,
                      BakeArguments& arguments,
                      const std::string& only_option = "--only-faces");

// --tiles, --tile-record and what belongs to them.
void AddTileArguments(CLI::App* command, BakeArguments& arguments);

// Pictures come and go. Without --memory, what they took stays with the program for what it needs
// next, since the system would clear the pages each time; with it, it goes back to the system.
void ConfigureMallocTrimming(const BakeArguments& arguments);

// Takes --exclude, --masks, --only and the scene's pairs.csv into account. A photograph whose mask
// from --masks cannot be used is left out; returns a line for each of these.
std::vector<std::string> NarrowPhotographs(const BakeArguments& arguments,
                                           const Scene& scene,
                                           std::vector<BakePhotograph>& photographs);

// Writes out/tiles/ if --tiles or --tile-record asks for it.
void WriteTilesIfAsked(const BakeArguments& arguments,
                       const PolygonModel& model,
                       std::vector<BakePhotograph> photographs,
                       const std::filesystem::path& out);

}  // namespace groundglass
