// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/opened_folder.h"

#include "scene/error.h"
#include "scene/formats/output_folder.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/scene_folder.h"

#include <cmath>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// A scene with faults of single photographs is still one; without a model there is nothing to see.
Scene ReadWhatIsThere(const fs::path& folder, const ModelOptions& options) {
  SceneOptions scene_options;
  scene_options.model = options;
  SceneCheck check = ScanScene(folder, scene_options);
  if (check.scene.model.faces.empty() && !check.faults.empty()) throw Error(check.faults.front());
  return std::move(check.scene);
}

}  // namespace

bool IsSameModel(const PolygonModel& a, const PolygonModel& b) {
  if (a.faces.size() != b.faces.size() || a.faces.empty()) return false;
  const double size_a = ComputeBounds(a).Diagonal();
  return std::abs(ComputeBounds(b).Diagonal() - size_a) < 0.01 * size_a;
}

OpenedFolder OpenFolder(const fs::path& folder,
                        const fs::path& scene_folder,
                        const ModelOptions& options,
                        bool with_pages) {
  OpenedFolder opened;
  if (fs::is_regular_file(folder)) {
    opened.textured = ReadTexturedModel(folder, options, with_pages).textured;
    opened.scene.model = opened.textured.model;
    return opened;
  }
  if (!fs::is_directory(folder)) {
    throw Error(folder, "no such folder; expected an output folder or a scene, or a model");
  }
  opened.is_output = IsOutputFolder(folder);
  if (!opened.is_output) {
    if (!scene_folder.empty()) {
      throw Error(folder, "is no output folder of a run; with --scene one is expected");
    }
    opened.scene = ReadWhatIsThere(folder, options);
    opened.textured.model = opened.scene.model;
    return opened;
  }
  if (!scene_folder.empty()) opened.scene = ReadWhatIsThere(scene_folder, options);
  if (fs::exists(folder / "model.glb")) {
    opened.textured = ReadTexturedModel(folder / "model.glb", options, with_pages).textured;
    if (!IsSameModel(opened.scene.model, opened.textured.model)) {
      opened.scene.model = opened.textured.model;
    }
  } else if (scene_folder.empty()) {
    throw Error(folder, "has no model.glb; say where the model is with --scene");
  } else {
    opened.textured.model = opened.scene.model;
  }
  if (fs::exists(folder / "registration.json")) {
    opened.registrations = ReadRegistrations(folder / "registration.json");
  }
  return opened;
}

}  // namespace groundglass
