// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"
#include "scene/formats/lens.h"
#include "scene/formats/model_io.h"
#include "scene/polygon_model.h"
#include "scene/view_tag.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph with its tag, as found in a scene folder.
struct Photograph {
  std::string name;  // the stem: "s5" (image_paths.h)
  std::filesystem::path image_file;
  ImageSize size;  // px, orientation applied
  ViewTag tag;
  std::filesystem::path view_file;                  // empty if the tag came from elsewhere
  std::optional<std::filesystem::path> mask_file;   // white = ignore
  std::optional<std::filesystem::path> faces_file;  // hand-painted face mask
  // What calibration/ has of it, for the keys that its tag lacks (docs/scene-folder.md).
  std::optional<std::filesystem::path> calibration_file;
  std::optional<Lens> lens;  // in place of the tag's own where the tag says no view angle
};

// A photograph that is there and cannot be used: its picture is damaged, its tag says something
// impossible, its mask does not fit.
struct UnreadablePhotograph {
  Photograph photograph;             // as far as it could be read; size 0 x 0 if not known
  std::vector<std::string> reasons;  // lines for a person, with file and place; one at least
};

// Everything that a scene folder holds (docs/scene-folder.md), read and checked; photographs in
// natural name order (s2 before s10).
struct Scene {
  std::filesystem::path folder;
  std::filesystem::path model_file;
  PolygonModel model;
  std::vector<Photograph> photographs;
  // The files of the COLMAP model that gave the tags, if one did.
  std::vector<std::filesystem::path> camera_files;
  bool tags_have_angles = false;  // a table's, which gives yaw,pitch in place of i,j,k
  std::vector<UnreadablePhotograph> unreadable;
  std::vector<std::string> left_out;  // names of photographs that the options leave out
  std::vector<std::filesystem::path> untagged_images;  // photographs that no tag is there for
  std::map<std::filesystem::path, std::filesystem::path> masks_of_untagged;  // by their images
  std::vector<std::string> warnings;  // a photograph without a tag, a tag without a photograph, ...
  std::vector<std::filesystem::path> lens_files;  // of calibration/
  // What the tags lack and was taken from calibration/ or from the pictures' metadata; one line
  // each, for a person.
  std::vector<std::string> notes;
};

struct SceneOptions {
  std::optional<std::filesystem::path> model_file;  // in place of the one in the folder
  ModelOptions model;
  // Cameras in place of the scene's tags: a COLMAP model (colmap_io.h) or a folder of .view files.
  // Its own tags are not looked at. A camera becomes the tag that describes it, its look-at point
  // as far away as the model's middle.
  std::optional<std::filesystem::path> views;
  // Only these photographs, by name; empty: all. Faults of others do not matter.
  std::vector<std::string> only;
  // Photographs that are not needed for what follows: their faults do not matter.
  std::vector<std::string> exclude;
};

// A scene as far as it could be read, and one line for each fault, ready for a person.
struct SceneCheck {
  Scene scene;
  std::vector<std::string> faults;
};
}  // namespace groundglass
