// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/webp_exif.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>

namespace groundglass {
namespace {

// What no camera's block exceeds.
constexpr uint32_t kMostBytes = 1 << 20;

uint32_t LittleEndian(const char* bytes) {
  uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<uint8_t>(bytes[i]);
  return value;
}

}  // namespace

std::string ReadWebpExif(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 12> header{};
  if (!in.read(header.data(), header.size())) return "";
  const std::string_view words(header.data(), header.size());
  if (!words.starts_with("RIFF") || !words.ends_with("WEBP")) return "";
  // Chunks: a name, the number of bytes, the bytes, filled up to an even number.
  std::array<char, 8> chunk{};
  while (in.read(chunk.data(), chunk.size())) {
    const uint32_t num_bytes = LittleEndian(chunk.data() + 4);
    if (std::string_view(chunk.data(), 4) != "EXIF") {
      in.seekg(static_cast<std::streamoff>(num_bytes) + num_bytes % 2, std::ios::cur);
      continue;
    }
    if (num_bytes > kMostBytes) return "";
    std::string block(num_bytes, '\0');
    if (!in.read(block.data(), num_bytes)) return "";
    // As in a JPEG, which the format does not ask for.
    constexpr std::string_view kMark("Exif\0\0", 6);
    return block.starts_with(kMark) ? block.substr(kMark.size()) : block;
  }
  return "";
}

}  // namespace groundglass
