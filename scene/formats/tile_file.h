// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>

namespace groundglass {

// The unit of the 1988 texture database (Thorman 1988, "Storing the database"): four neighbouring
// pixels of a photograph, put where they lie on a face. 24 floats, 96 bytes.
struct TileCorner {
  float x = 0, y = 0, z = 0;  // `site` frame, model's unit
  float r = 0, g = 0, b = 0;  // sRGB codes, 0 to 1
};
struct Tile {
  // Clockwise as the photograph shows them: top left, top right, bottom right, bottom left.
  std::array<TileCorner, 4> corners;
};
static_assert(sizeof(Tile) == 96);

// A .tiles file is nothing but tiles, one after the other, little-endian. `write` is given what
// appends to it. Written beside its place and renamed into it. Throws Error.
using TileSink = std::function<void(std::span<const Tile>)>;
void WriteTiles(const std::filesystem::path& file,
                const std::function<void(const TileSink& append)>& write);

// A .tiles file in the address space: what is read comes from disk when it is touched, and the
// system may drop it again, so that a database may be larger than memory.
class MappedTiles {
 public:
  // Error if it cannot be read, or its size is no whole number of tiles.
  explicit MappedTiles(const std::filesystem::path& file);
  ~MappedTiles();
  MappedTiles(MappedTiles&& other) noexcept;
  MappedTiles& operator=(MappedTiles&&) = delete;

  std::span<const Tile> Tiles() const { return {tiles_, num_tiles_}; }

 private:
  const Tile* tiles_ = nullptr;
  size_t num_tiles_ = 0;
};

}  // namespace groundglass
