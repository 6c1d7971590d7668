// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/error.h"
#include "scene/formats/own_tiny_gltf.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

[[noreturn]] void FailGltf(const std::filesystem::path& file, const std::string& message);

// An item that the file names by its place.
template <typename T>
const T& GltfItem(const std::vector<T>& items,
                  int index,
                  const char* what,
                  const std::filesystem::path& file) {
  if (index < 0 || static_cast<size_t>(index) >= items.size()) {
    FailGltf(file, std::string("it names a ") + what + " that it does not have");
  }
  return items[static_cast<size_t>(index)];
}

// An accessor's numbers, `width` to an element; whole numbers are scaled if they are marked so,
// and a sparse one's exceptions are in place.
std::vector<double> ReadGltfAccessor(const tinygltf::Model& gltf,
                                     int index,
                                     int width,
                                     const std::filesystem::path& file);

}  // namespace groundglass
