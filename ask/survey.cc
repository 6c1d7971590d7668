// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/survey.h"

#include "register/register.h"
#include "scene/error.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/scene_folder.h"

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

void AddUntagged(const Scene& scene, Survey& survey) {
  for (const fs::path& image : scene.untagged_images) {
    survey.left_out.push_back({image.stem().string(), "it has no tag"});
  }
}

Survey SurveyOfScene(const Scene& scene) {
  Survey survey;
  survey.model = scene.model;
  for (const Photograph& photograph : scene.photographs) {
    survey.photographs.push_back(AsWritten(photograph, survey.model));
  }
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    survey.left_out.push_back({unreadable.photograph.name, unreadable.reasons.front()});
  }
  AddUntagged(scene, survey);
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

}  // namespace

Survey SurveyOf(const OpenedFolder& opened) {
  Survey survey;
  // Where nothing was registered the tags are what is known.
  if (opened.registrations.empty()) {
    survey = SurveyOfScene(opened.scene);
  } else {
    survey.model = opened.scene.model;
    for (const Registration& registration : opened.registrations) {
      AddRegistration(registration, opened.scene, survey);
    }
    AddUntagged(opened.scene, survey);
  }
  survey.textures = opened.textured.faces;
  return survey;
}

Survey ReadSurvey(const fs::path& folder,
                  const fs::path& scene_folder,
                  const ModelOptions& options) {
  return SurveyOf(OpenFolder(folder, scene_folder, options, false));
}

int FindSurveyPhotograph(const Survey& survey, const std::string& word) {
  std::vector<PhotographName> names;
  for (const SurveyPhotograph& photograph : survey.photographs) {
    names.push_back({photograph.name, photograph.image_file.filename().string()});
  }
  if (const std::optional<size_t> found = FindPhotograph(word, names)) {
    return static_cast<int>(*found);
  }
  std::vector<PhotographName> left_out;
  for (const LeftOutPhotograph& one : survey.left_out) left_out.push_back({one.name, ""});
  if (const std::optional<size_t> found = FindPhotograph(word, left_out)) {
    const LeftOutPhotograph& one = survey.left_out[*found];
    throw Error("photograph " + one.name + " has no camera that can be asked: " + one.reason);
  }
  names.insert(names.end(), left_out.begin(), left_out.end());
  constexpr size_t kMostNamed = 30;
  std::string all;
  for (size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) {
    all += (i == 0 ? " " : ", ") + names[i].name;
  }
  if (names.size() > kMostNamed) all += ", ...";
  throw Error("there is no photograph " + word + NearestName(word, names) + "; there are" + all);
}

}  // namespace groundglass
