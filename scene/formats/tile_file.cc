// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/tile_file.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <string>
#include <utility>

namespace groundglass {

static_assert(std::endian::native == std::endian::little, "tiles are written as they are");

void WriteTiles(const std::filesystem::path& file,
                const std::function<void(const TileSink& append)>& write) {
  StreamFileAtomically(file, [&](const ByteSink& append) {
    write([&](std::span<const Tile> tiles) {
      append({reinterpret_cast<const char*>(tiles.data()), tiles.size_bytes()});
    });
  });
}

MappedTiles::MappedTiles(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status = {};
  if (descriptor < 0 || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    if (descriptor >= 0) close(descriptor);
    throw Error(file, "cannot read this as a file of tiles");
  }
  const auto num_bytes = static_cast<size_t>(status.st_size);
  if (num_bytes % sizeof(Tile) != 0) {
    close(descriptor);
    throw Error(file,
                "is no file of tiles: " + std::to_string(num_bytes) +
                    " bytes are no whole number of tiles of 96");
  }
  void* mapped = nullptr;
  if (num_bytes > 0) mapped = mmap(nullptr, num_bytes, PROT_READ, MAP_PRIVATE, descriptor, 0);
  close(descriptor);
  if (mapped == MAP_FAILED) throw Error(file, "cannot map this file of tiles into memory");
  tiles_ = static_cast<const Tile*>(mapped);
  num_tiles_ = num_bytes / sizeof(Tile);
}

MappedTiles::~MappedTiles() {
  if (tiles_) munmap(const_cast<Tile*>(tiles_), num_tiles_ * sizeof(Tile));
}

MappedTiles::MappedTiles(MappedTiles&& other) noexcept
    : tiles_(std::exchange(other.tiles_, nullptr)),
      num_tiles_(std::exchange(other.num_tiles_, 0)) {}

}  // namespace groundglass
