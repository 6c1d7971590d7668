// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/formats/colmap_io.h"
#include "scene/view_tag.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A clean picture from where no photograph was taken: what a textured model is judged by.
struct NovelView {
  std::string name;  // "n1"
  ViewTag tag;       // exact
  std::filesystem::path image_file;
  std::filesystem::path faces_file;  // the face that each pixel shows, from 1; 0 for none
};

// What is known of a scene for judging (the `truth` folder of the formats page). All but the
// cameras may be absent.
struct Truth {
  std::filesystem::path folder;
  std::vector<NamedCamera> cameras;  // names without extension ("s5"), in natural order
  std::vector<NovelView> novel_views;
  // The photographs' face masks without and with what stands before the model; empty if absent.
  std::filesystem::path masks_model_folder;
  std::filesystem::path masks_occ_folder;
  std::filesystem::path surfaces_folder;  // exact colours of the building; may be empty
};

// Throws Error naming the folder or file at fault.
Truth ReadTruth(const std::filesystem::path& folder);

// The cameras found in a folder, named without extension and in natural order: .view files in
// `folder` or `folder`/views, or a COLMAP text model in `folder` or `folder`/cameras. A view file
// does not say its picture's size, so it takes that of the true camera of the same name; views
// without one are left out. Throws Error if there is nothing of the kind.
std::vector<NamedCamera> ReadFoundCameras(const std::filesystem::path& folder, const Truth& truth);

}  // namespace groundglass
