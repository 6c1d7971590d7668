// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/survey.h"

#include "register/register.h"
#include "scene/error.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/scene_folder.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

SurveyPhotograph AsWritten(const Photograph& photograph, const PolygonModel& model) {
  const CameraPrior prior = MakeCameraPrior(photograph.tag,
                                            photograph.size.width,
                                            photograph.size.height,
                                            model.unit,
                                            photograph.lens,
                                            PriorSuitedTo(model, {}));
  return {photograph.name,
          photograph.size.width,
          photograph.size.height,
          photograph.tag,
          prior.root * prior.root.transpose(),
          "as written",
          photograph.image_file,
          photograph.mask_file};
}

Survey SurveyOfScene(Scene scene) {
  Survey survey;
  survey.model = std::move(scene.model);
  for (const Photograph& photograph : scene.photographs) {
    survey.photographs.push_back(AsWritten(photograph, survey.model));
  }
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    survey.left_out.push_back({unreadable.photograph.name, unreadable.reasons.front()});
  }
  for (const fs::path& image : scene.untagged_images) {
    survey.left_out.push_back({image.stem().string(), "it has no tag"});
  }
  return survey;
}

void AddRegistration(const Registration& registration, const Scene& scene, Survey& survey) {
  if (!HasCorrection(registration.verdict)) {
    std::string reason(VerdictName(registration.verdict));
    if (!registration.reasons.empty()) reason += ": " + registration.reasons.front();
    survey.left_out.push_back({registration.name, reason});
    return;
  }
  SurveyPhotograph photograph = {registration.name,
                                 registration.width_px,
                                 registration.height_px,
                                 registration.corrected,
                                 registration.covariance,
                                 std::string(VerdictName(registration.verdict)),
                                 {},
                                 {}};
  if (const Photograph* file = FindUsablePhotograph(scene, registration.name)) {
    photograph.image_file = file->image_file;
    photograph.mask_file = file->mask_file;
  }
  survey.photographs.push_back(std::move(photograph));
}

Scene ReadSceneToAsk(const fs::path& folder, const ModelOptions& options) {
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

Survey ReadSurvey(const fs::path& folder,
                  const fs::path& scene_folder,
                  const ModelOptions& options) {
  if (!fs::is_directory(folder)) {
    throw Error(folder, "no such folder; expected an output folder or a scene");
  }
  if (!fs::exists(folder / "registration.json")) {
    if (!scene_folder.empty()) {
      throw Error(folder, "has no registration.json; with --scene an output folder is expected");
    }
    return SurveyOfScene(ReadSceneToAsk(folder, options));
  }
  Scene scene;
  if (!scene_folder.empty()) scene = ReadSceneToAsk(scene_folder, options);
  Survey survey;
  survey.model = scene.model;
  const fs::path textured_file = folder / "model.glb";
  if (fs::exists(textured_file)) {
    TexturedModel textured = ReadTexturedModel(textured_file, options).textured;
    // The cameras belong to the model that they were found with.
    if (!IsSameModel(survey.model, textured.model)) survey.model = textured.model;
    survey.textures = textured.faces;
  } else if (scene_folder.empty()) {
    throw Error(folder, "has no model.glb; say where the model is with --scene");
  }
  for (const Registration& registration : ReadRegistrations(folder / "registration.json")) {
    AddRegistration(registration, scene, survey);
  }
  return survey;
}

int FindSurveyPhotograph(const Survey& survey, const std::string& word) {
  std::vector<PhotographName> names;
  for (const SurveyPhotograph& photograph : survey.photographs) {
    names.push_back({photograph.name, photograph.image_file.filename().string()});
  }
  if (const std::optional<size_t> found = FindPhotograph(word, names)) {
    return static_cast<int>(*found);
  }
  for (const LeftOutPhotograph& left_out : survey.left_out) {
    if (left_out.name == word) {
      throw Error("photograph " + word + " has no camera that can be asked: " + left_out.reason);
    }
  }
  throw Error("there is no photograph " + word + NearestName(word, names));
}

}  // namespace groundglass
