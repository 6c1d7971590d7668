// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/colmap_io.h"
#include "scene/formats/model_io.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What a conversion did: one line for a person, and what was odd.
struct ConvertResult {
  std::string summary;
  std::vector<std::string> warnings;
  std::vector<int> faces_left_out = {};  // of a model, their numbers in the input
};

// A model from any format that is read to .osu, .obj or .glb, by the output's extension. Textures
// go along from .glb and textured .obj to either. output_unit: what the lengths are written in;
// none: the model's own. Throws Error.
ConvertResult ConvertModel(const std::filesystem::path& input,
                           const std::filesystem::path& output,
                           const ModelOptions& options,
                           const std::optional<LengthUnit>& output_unit = std::nullopt);

// A COLMAP model (text or binary) in `world` to a folder of view files, each named after its image
// (image_paths.h); nothing is written unless all can be.
// lookat_distance: how far ahead the look-at points are put, in the model's unit.
ConvertResult ConvertColmapToViews(const std::filesystem::path& input,
                                   const std::filesystem::path& output,
                                   double lookat_distance);

// The cameras of a folder of view files, or of a scene. The sizes and names of the images come from
// `images` (empty: the folder images/ beside the view files'), matched by name, in sub-folders too;
// a warning for each view that has none, an Error if none has.
struct ViewCameras {
  std::vector<NamedCamera> cameras;
  std::filesystem::path images;  // where they were found
  std::vector<std::string> warnings;
};
ViewCameras ReadViewCameras(const std::filesystem::path& folder,
                            const std::filesystem::path& images);

// The same as a COLMAP text model. images: as above.
ConvertResult ConvertViewsToColmap(const std::filesystem::path& input,
                                   const std::filesystem::path& output,
                                   const std::filesystem::path& images);

}  // namespace groundglass
