// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/bake_photograph.h"
#include "scene/formats/tile_file.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <filesystem>
#include <span>
#include <vector>

namespace groundglass {

struct TileOptions {
  // This many pixels are averaged into one, in linear light: 1, 4, 9 or 16. Raise it where the
  // database gets too large.
  int downsample = 1;

  void Check() const;  // throws Error
};

// For each photograph the faces that it textures in the 1988 database, ascending: each face is
// textured by no more than one photograph, the one with the most pixels on it (weight included).
// BakePhotograph::faces restricts the choice, as the thesis' table of image-face pairs did by hand.
std::vector<std::vector<int>> PairFacesWithPhotographs(const PolygonModel& model,
                                                       std::span<const BakePhotograph> photographs,
                                                       const TileOptions& options = {});

// The tiles of one photograph on these faces (ascending), row by row: one for every four
// neighbouring pixels that all show the same one of them, each put where its line of sight meets
// the face's plane. A photograph of 500 x 400 pixels that shows a single face has 499 x 399.
// Masked pixels make none. Throws Error for images that cannot be read or do not fit the camera.
void MakeTiles(const PolygonModel& model,
               const Visibility& visibility,
               const BakePhotograph& photograph,
               std::span<const int> faces,
               const TileOptions& options,
               const TileSink& sink);

// What is needed to compute tiles again, in place of the tiles (Thorman 1988, "Suggested
// improvements"): the view transformations, and which photograph textures which faces.
struct TileRecord {
  PolygonModel model;
  std::vector<BakePhotograph> photographs;  // `faces` holds those that it textures
  TileOptions options;
};
// folder/record.json, folder/model.osu and folder/views/NAME.view. The photographs stay where they
// are; record.json names them relative to the folder.
void WriteTileRecord(const std::filesystem::path& folder, const TileRecord& record);
TileRecord ReadTileRecord(const std::filesystem::path& folder);  // throws Error

// The tiles of all faces that turn their front to the camera, from the photographs as they are now.
void RecomputeTiles(const TileRecord& record, const Camera& camera, const TileSink& sink);

}  // namespace groundglass
