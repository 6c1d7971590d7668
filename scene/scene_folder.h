// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image_io.h"
#include "scene/model_io.h"
#include "scene/polygon_model.h"
#include "scene/view_tag.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph with its tag, as found in a scene folder.
struct Photograph {
  std::string name;  // the stem: "s5"
  std::filesystem::path image_file;
  ImageSize size;  // px, orientation applied
  ViewTag tag;
  std::filesystem::path view_file;                  // empty if the tag came from tags.csv
  std::optional<std::filesystem::path> mask_file;   // white = ignore
  std::optional<std::filesystem::path> faces_file;  // hand-painted face mask
};

// Everything that a scene folder holds (docs/scene-folder.md), read and checked; photographs in
// natural name order (s2 before s10).
struct Scene {
  std::filesystem::path folder;
  std::filesystem::path model_file;
  PolygonModel model;
  std::vector<Photograph> photographs;
  std::vector<std::filesystem::path> untagged_images;  // photographs that no tag is there for
  std::vector<std::string> warnings;  // a photograph without a tag, a tag without a photograph, ...
};

struct SceneOptions {
  std::optional<std::filesystem::path> model_file;  // in place of the one in the folder
  ModelOptions model;
};

// Throws Error with the first fault.
Scene ReadScene(const std::filesystem::path& folder, const SceneOptions& options = {});

// The same, but collects every fault instead of stopping at the first: all that could be read, and
// one line for each fault, ready for a person.
struct SceneCheck {
  Scene scene;
  std::vector<std::string> faults;
};
SceneCheck CheckScene(const std::filesystem::path& folder, const SceneOptions& options = {});

// "s2" < "s10": runs of digits compare as numbers.
bool NaturalLess(const std::string& a, const std::string& b);

}  // namespace groundglass
