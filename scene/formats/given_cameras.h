// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/colmap_io.h"
#include "scene/formats/image_io.h"
#include "scene/polygon_model.h"
#include "scene/view_tag.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace groundglass {

// The cameras of a COLMAP model, each for one of a scene's photographs.
struct GivenCameras {
  std::vector<std::filesystem::path> files;  // of the model
  // By index of the photograph; for the image size that COLMAP had.
  std::map<size_t, NamedCamera> camera_of_image;
  // By index of the photograph: why the model has no camera for it.
  std::map<size_t, std::vector<std::string>> faults_of_image;
  std::vector<std::string> strays;    // the model's images without a photograph
  std::vector<std::string> warnings;  // images without a photograph, photographs without an image
  std::vector<std::string> faults;    // two images for one photograph
};
// image_paths: the photographs, below the folder of images.
GivenCameras MatchColmapModel(const ColmapFiles& files,
                              const std::vector<std::string>& image_paths);

// The camera for the picture as we read it: turned as EXIF says, which COLMAP does not look at, and
// scaled to its size. Throws Error if the shapes differ; what had to be done is told in `change`.
struct FittedCamera {
  Camera camera;
  std::string change;  // empty: nothing had to be done
};
FittedCamera FitCamera(const Camera& camera,
                       const ImageSize& size,
                       const std::filesystem::path& image_file);

// The tag of a camera that says nothing of what it looks at: the look-at point is put as far away
// as the model's middle.
ViewTag TagForModel(const Camera& camera, const PolygonModel& model);

}  // namespace groundglass
