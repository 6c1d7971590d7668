// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/document.h"

#include "ask/survey.h"
#include "scene/error.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/scene_folder.h"
#include "session/journal.h"

namespace groundglass {
namespace {

namespace fs = std::filesystem;

void ReadTheScene(const fs::path& folder, const ModelOptions& options, Document& document) {
  SceneOptions scene_options;
  scene_options.model = options;
  SceneCheck check = ScanScene(folder, scene_options);
  if (check.scene.model.faces.empty() && !check.faults.empty()) throw Error(check.faults.front());
  document.scene = std::move(check.scene);
  document.journal_file = Journal::PlaceFor(folder);
}

}  // namespace

Document OpenDocument(const WindowOptions& options) {
  const fs::path& folder = options.folder;
  Document document;
  document.title = folder.filename().empty() ? folder.parent_path().filename().string()
                                             : folder.filename().string();
  if (fs::is_regular_file(folder)) {
    document.textured = ReadTexturedModel(folder, options.model).textured;
    document.scene.model = document.textured.model;
    return document;
  }
  if (!fs::is_directory(folder)) {
    throw Error(folder, "no such file or folder; expected a scene, an output folder or a model");
  }
  const bool is_output =
      fs::exists(folder / "registration.json") || fs::exists(folder / "model.glb");
  if (!is_output || !options.scene_folder.empty()) {
    ReadTheScene(is_output ? options.scene_folder : folder, options.model, document);
    document.textured.model = document.scene.model;
  }
  if (is_output && fs::exists(folder / "model.glb")) {
    TexturedModel textured = ReadTexturedModel(folder / "model.glb", options.model).textured;
    document.textured = std::move(textured);
    if (!IsSameModel(document.scene.model, document.textured.model)) {
      document.scene.model = document.textured.model;
    }
  }
  if (document.textured.model.faces.empty()) {
    throw Error(folder, "has no model.glb; say where the scene is with --scene");
  }
  if (fs::exists(folder / "registration.json")) {
    for (Registration& registration : ReadRegistrations(folder / "registration.json")) {
      const std::string name = registration.name;
      document.registrations[name] = std::move(registration);
    }
  }
  return document;
}

}  // namespace groundglass
