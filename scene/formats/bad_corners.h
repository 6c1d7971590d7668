// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/polygon_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A face with a corner that is no point of the model's.
struct BadCorner {
  int face = -1;     // its place among the file's faces, good and bad
  std::string text;  // "point 99 is outside 1 to 8"
};

// One warning for all these faces (in order, one entry for each), which are left out. Throws Error
// if they are most of the faces: then the file is damaged as a whole. `model` has all faces and
// their numbers; lines: where each face stands; empty if the file has no lines.
std::string WarnOfBadCorners(const std::filesystem::path& file,
                             const std::vector<int>& lines,
                             const PolygonModel& model,
                             const std::vector<BadCorner>& bad);

// What is left of a list with an item for each face.
template <typename T>
void DropFaces(const std::vector<BadCorner>& bad, std::vector<T>& items) {
  std::vector<T> kept;
  size_t next = 0;
  for (size_t i = 0; i < items.size(); ++i) {
    if (next < bad.size() && static_cast<size_t>(bad[next].face) == i) {
      ++next;
    } else {
      kept.push_back(std::move(items[i]));
    }
  }
  items = std::move(kept);
}

}  // namespace groundglass
