// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"
#include "tests/support/temporary_folder.h"

#include <string>

namespace groundglass {

inline constexpr const char* kModel = "4 1\n0 0 0\n10 0 0\n10 0 5\n0 0 5\n4 1 2 3 4 % south wall\n";
// 20 south of the wall, looking north at its middle.
inline constexpr const char* kTag = "x 5 y 20 z 2\ni 5 j 0 k 2\na 1.5 v 40\n";

// A small scene that is in order: two photographs, one of them masked.
class SceneFolder : public TemporaryFolder {
 public:
  SceneFolder() {
    Write("model.osu", kModel);
    for (const std::string name : {"s2", "s10"}) {
      Write("views/" + name + ".view", kTag);
      WriteSrgb8(path() / "images" / (name + ".jpg"), Image8(30, 20, 3, 128));
    }
    WriteLabels(path() / "masks/s2.png", Image16(30, 20, 1));
    WriteLabels(path() / "faces/s10.png", Image16(30, 20, 1, 1));
  }
};

}  // namespace groundglass
