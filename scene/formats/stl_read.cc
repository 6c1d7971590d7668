// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/mesh_io.h"
#include "scene/formats/view_io.h"
#include "scene/formats/word_scanner.h"
#include "scene/text.h"

#include <cmath>
#include <cstring>

namespace groundglass {
namespace {

constexpr size_t kHeaderBytes = 80;
constexpr size_t kStartBytes = kHeaderBytes + 4;  // with the number of triangles
constexpr size_t kTriangleBytes = 50;             // normal, three corners, two bytes

uint32_t ReadCount(std::string_view bytes) {
  uint32_t count = 0;
  for (size_t i = 0; i < 4; ++i) {
    count |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[kHeaderBytes + i])) << (8 * i);
  }
  return count;
}

float ReadFloat(std::string_view bytes, size_t at) {
  uint32_t bits = 0;
  for (size_t i = 0; i < 4; ++i) {
    bits |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  float value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// Binary files may begin with "solid" too: their length tells, or what follows.
bool IsTextStl(std::string_view bytes) {
  constexpr size_t kLookedAt = 2048;
  std::string_view start = bytes.substr(0, kLookedAt);
  if (start.substr(0, 3) == "\xEF\xBB\xBF") start.remove_prefix(3);
  const size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const std::string lower = LowerCase(start.substr(first));
  if (!lower.starts_with("solid") && !lower.starts_with("facet")) return false;
  if (bytes.size() >= kStartBytes &&
      bytes.size() == kStartBytes + kTriangleBytes * static_cast<size_t>(ReadCount(bytes))) {
    return false;
  }
  if (lower.find('\0') != std::string::npos) return false;
  return lower.find("facet") != std::string::npos || lower.find("endsolid") != std::string::npos;
}

void AddFace(const std::vector<Eigen::Vector3d>& corners,
             const std::string& name,
             PolygonModel& model) {
  Face& face = model.faces.emplace_back();
  face.number = static_cast<int>(model.faces.size());
  face.name = name;
  for (const Eigen::Vector3d& corner : corners) {
    face.points.push_back(static_cast<int>(model.points_in_world.size()));
    model.points_in_world.push_back(corner);
  }
}

void ReadText(std::string_view text, const std::filesystem::path& file, PolygonModel& model) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  WordScanner words(text);
  std::string name;  // of the solid
  std::vector<Eigen::Vector3d> corners;
  bool is_in_facet = false;
  for (;;) {
    const std::string_view word = words.Next();
    if (word.empty()) break;
    const std::string keyword = LowerCase(word);
    if (keyword == "solid") {
      name = words.RestOfLine();
    } else if (keyword == "endsolid") {
      words.RestOfLine();
      name.clear();
    } else if (keyword == "facet") {
      is_in_facet = true;
      corners.clear();
      words.RestOfLine();  // its normal follows from its corners
    } else if (keyword == "vertex") {
      Eigen::Vector3d& corner = corners.emplace_back();
      for (double& coordinate : corner) {
        const std::string_view number = words.Next();
        const auto value = ParseNumber(number);
        if (!value) {
          throw Error(file,
                      words.line(),
                      number.empty() ? "the file ends amid a vertex"
                                     : Quote(number) + " is not a finite number");
        }
        coordinate = OrNoPlace(*value);
      }
    } else if (keyword == "endloop" || keyword == "endfacet") {
      if (is_in_facet && !corners.empty()) AddFace(corners, name, model);
      corners.clear();
      if (keyword == "endfacet") is_in_facet = false;
    } else if (keyword != "outer" && keyword != "loop") {
      throw Error(file,
                  words.line(),
                  "expected solid, facet, outer loop, vertex, endloop, endfacet or endsolid, not " +
                      Quote(word));
    }
  }
  if (is_in_facet) throw Error(file, words.line(), "the file ends amid a facet");
}

void ReadBinary(std::string_view bytes,
                const std::filesystem::path& file,
                PolygonModel& model,
                std::vector<std::string>& warnings) {
  if (bytes.size() < kStartBytes) {
    throw Error(file, "is no STL file: it has less than 84 bytes and does not begin with solid");
  }
  size_t count = ReadCount(bytes);
  const size_t held = (bytes.size() - kStartBytes) / kTriangleBytes;
  // Programs that write while they work leave the number open.
  if ((count == 0 || count == 0xFFFFFFFF) && held > 0 &&
      (bytes.size() - kStartBytes) % kTriangleBytes == 0) {
    warnings.push_back(
        Error(file,
              "its header counts no triangles; the " + std::to_string(held) + " in it are read")
            .what());
    count = held;
  }
  if (count > held) {
    throw Error(file,
                "cannot read this model: its header counts " + std::to_string(count) +
                    " triangles, but the file ends after " + std::to_string(held) +
                    "; it is cut short or damaged");
  }
  const size_t end = kStartBytes + count * kTriangleBytes;
  if (end < bytes.size()) {
    warnings.push_back(
        Error(file,
              std::to_string(bytes.size() - end) + " bytes after the last triangle are not read")
            .what());
  }
  for (size_t i = 0; i < count; ++i) {
    const size_t at = kStartBytes + i * kTriangleBytes + 12;
    std::vector<Eigen::Vector3d> corners;
    for (size_t corner = 0; corner < 3; ++corner) {
      const size_t place = at + 12 * corner;
      corners.emplace_back(OrNoPlace(ReadFloat(bytes, place)),
                           OrNoPlace(ReadFloat(bytes, place + 4)),
                           OrNoPlace(ReadFloat(bytes, place + 8)));
    }
    AddFace(corners, "", model);
  }
}

}  // namespace

MeshReading ReadStl(const std::filesystem::path& file) {
  const std::string bytes = ReadFileBytes(file);
  MeshReading reading;
  PolygonModel& model = reading.textured.model;
  model.is_unit_assumed = true;
  if (IsTextStl(bytes)) {
    ReadText(bytes, file, model);
  } else {
    ReadBinary(bytes, file, model, reading.warnings);
  }
  JoinIdenticalPoints(model);
  return reading;
}

}  // namespace groundglass
