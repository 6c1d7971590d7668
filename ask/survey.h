// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "ask/opened_folder.h"
#include "scene/formats/model_io.h"
#include "scene/registration.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A photograph that can be asked: its camera, and how sure that is.
struct SurveyPhotograph {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  ViewTag tag;  // the camera
  CameraCovariance covariance = CameraCovariance::Zero();
  std::string standing;              // "accepted", "review", or "as written": never corrected
  std::filesystem::path image_file;  // empty where no scene was given
  std::optional<std::filesystem::path> mask_file;  // white = ignore

  Camera AsCamera() const { return CameraFromTag(tag, width_px, height_px); }
};

// One that cannot, and why.
struct LeftOutPhotograph {
  std::string name;
  std::string reason;
};

// A model and the cameras that saw it: what questions of place are put to.
struct Survey {
  PolygonModel model;
  std::vector<FaceTexture> textures;  // one for each face; empty without a texture
  std::vector<SurveyPhotograph> photographs;
  std::vector<LeftOutPhotograph> left_out;
};

// The corrected cameras of an output folder; of a scene, and where nothing was registered, the
// cameras as written, with the standard deviations of their tags.
Survey SurveyOf(const OpenedFolder& opened);
// The same of what OpenFolder reads. Throws Error.
Survey ReadSurvey(const std::filesystem::path& folder,
                  const std::filesystem::path& scene_folder,
                  const ModelOptions& options = {});

// The photograph that this word means, as FindPhotograph has it. Throws Error naming the nearest,
// or why the photograph is left out.
int FindSurveyPhotograph(const Survey& survey, const std::string& word);

}  // namespace groundglass
