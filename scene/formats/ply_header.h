// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/length_unit.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// The head of a PLY file: which elements follow, and what each of them holds.
struct PlyHeader {
  enum class Format { kAscii, kLittleEndian, kBigEndian };
  enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
  struct Property {
    std::string name;  // lower case
    Type type = Type::kFloat;
    std::optional<Type> count_type;  // of a list
    int line = 0;
  };
  struct Element {
    std::string name;  // lower case
    size_t count = 0;
    std::vector<Property> properties;
    int line = 0;
  };
  Format format = Format::kAscii;
  std::vector<Element> elements;
  std::optional<LengthUnit> unit;     // of a "comment unit: m"
  std::vector<std::string> pictures;  // of every "comment TextureFile wall.jpg"
  size_t body = 0;                    // where the elements start in the file
  int body_line = 0;
};

size_t PlyTypeSize(PlyHeader::Type type);

// Throws Error naming the line; counts that the file is too short for are refused here.
PlyHeader ParsePlyHeader(std::string_view bytes, const std::filesystem::path& file);

}  // namespace groundglass
