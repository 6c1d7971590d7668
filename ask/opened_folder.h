// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/model_io.h"
#include "scene/formats/scene.h"
#include "scene/registration.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <vector>

namespace groundglass {

// A scene, what a run made of one, or both together.
struct OpenedFolder {
  bool is_output = false;
  // Its model is the one that the cameras belong to, and `textured`'s. Without photographs where
  // nobody says where those of an output folder are, and for a model alone.
  Scene scene;
  TexturedModel textured;
  std::vector<Registration> registrations;  // of an output folder: what was found
};

// Reads an output folder, a scene folder or a model file. scene_folder: where the photographs of an
// output folder are, and its model if it has none of its own; empty if nobody says. Where both have
// a model it is the run's, whose faces and unit its cameras know, unless they are one
// (IsSameModel). with_pages: the texture's pictures too. Photographs are not decoded. Throws Error.
OpenedFolder OpenFolder(const std::filesystem::path& folder,
                        const std::filesystem::path& scene_folder,
                        const ModelOptions& options,
                        bool with_pages);

// Whether two models are one in one unit: as many faces, and as large. Those that cameras were
// found with and that a scene holds now may differ, if only in unit.
bool IsSameModel(const PolygonModel& a, const PolygonModel& b);

}  // namespace groundglass
