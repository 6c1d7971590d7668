// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/evaluate.h"

#include "evaluate/oracle.h"
#include "evaluate/texel_map.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

ErrorSummary Summarise(std::vector<double> errors_px) {
  ErrorSummary summary;
  summary.count = static_cast<int>(errors_px.size());
  if (errors_px.empty()) return summary;
  std::sort(errors_px.begin(), errors_px.end());
  for (const double error_px : errors_px) summary.mean_px += error_px / summary.count;
  const size_t half = errors_px.size() / 2;
  summary.median_px =
      errors_px.size() % 2 == 1 ? errors_px[half] : (errors_px[half - 1] + errors_px[half]) / 2;
  summary.max_px = errors_px.back();
  return summary;
}

void EvaluateCameras(const fs::path& found,
                     const Truth& truth,
                     const PolygonModel& model,
                     Evaluation& evaluation) {
  std::map<std::string, Camera> camera_of_name;
  for (const NamedCamera& camera : ReadFoundCameras(found, truth)) {
    camera_of_name[camera.name] = camera.camera;
  }
  if (camera_of_name.empty()) return;
  std::map<std::string, Registration> registration_of_name;
  if (fs::exists(found / "registration.json")) {
    for (const Registration& registration : ReadRegistrations(found / "registration.json")) {
      registration_of_name[registration.name] = registration;
    }
  }
  std::vector<double> all_px;
  std::vector<double> accepted_px;
  for (const NamedCamera& true_camera : truth.cameras) {
    const auto camera = camera_of_name.find(true_camera.name);
    if (camera == camera_of_name.end()) {
      evaluation.missing.push_back(true_camera.name);
      continue;
    }
    PhotographEvaluation photograph;
    photograph.name = true_camera.name;
    photograph.errors = MeasureCameraErrors(model, true_camera.camera, camera->second);
    const double error_px = photograph.errors.vertex.mean_px;
    all_px.push_back(error_px);
    const auto registration = registration_of_name.find(true_camera.name);
    if (registration != registration_of_name.end() &&
        registration->second.verdict != Verdict::kUnreadable) {
      photograph.verdict = registration->second.verdict;
      const CameraErrors tag_errors =
          MeasureCameraErrors(model, true_camera.camera, registration->second.MeasuredCamera());
      photograph.start_px = tag_errors.vertex.mean_px;
      if (HasCorrection(*photograph.verdict)) {
        photograph.sigmas = registration->second.sigmas;
        photograph.calibration =
            MeasureCalibration(photograph.errors.parameters, registration->second.covariance);
        photograph.parameters = {tag_errors.parameters,
                                 photograph.errors.parameters,
                                 registration->second.prior_sigmas,
                                 registration->second.covariance};
      }
      if (photograph.verdict == Verdict::kAccepted) {
        accepted_px.push_back(error_px);
        photograph.is_wrong_accepted =
            error_px > WrongAcceptedThresholdPx(true_camera.camera.width_px);
      }
    }
    evaluation.num_wrong_accepted += photograph.is_wrong_accepted;
    evaluation.num_calibrated += photograph.calibration.has_value();
    evaluation.num_inside_95 += photograph.calibration && photograph.calibration->is_inside_95;
    evaluation.photographs.push_back(photograph);
  }
  if (evaluation.photographs.empty()) {
    throw Error(found, "no camera here has the name of one in " + truth.folder.string());
  }
  evaluation.all = Summarise(all_px);
  evaluation.accepted = Summarise(accepted_px);
}

void EvaluateMasks(const fs::path& found,
                   const Truth& truth,
                   const PolygonModel& model,
                   Evaluation& evaluation) {
  if (truth.masks_model_folder.empty() || !fs::is_directory(found / "faces")) return;
  evaluation.faces.resize(model.faces.size());
  for (const NamedCamera& camera : truth.cameras) {
    const fs::path file = found / "faces" / (camera.name + ".png");
    if (!fs::exists(file)) continue;
    const Image16 true_numbers = ReadLabels(truth.masks_model_folder / (camera.name + ".png"));
    const Image16 numbers = ReadLabels(file);
    if (numbers.width != true_numbers.width || numbers.height != true_numbers.height) {
      throw Error(file,
                  "is " + std::to_string(numbers.width) + " x " + std::to_string(numbers.height) +
                      " pixels, and its truth " + std::to_string(true_numbers.width) + " x " +
                      std::to_string(true_numbers.height) +
                      "; judge a run on photographs of the size that the truth has");
    }
    AddMaskOverlaps(KnownLabelsFromNumbers(model, true_numbers),
                    KnownLabelsFromNumbers(model, numbers),
                    evaluation.faces);
  }
}

// The pages' records of where each texel came from lie beside the model.
void ReadProvenance(const fs::path& found, TexturedModel& model) {
  for (size_t page = 0; page < model.pages.size(); ++page) {
    const fs::path file = found / ("provenance_" + std::to_string(page) + ".png");
    if (model.pages[page].provenance.Empty() && fs::exists(file)) {
      model.pages[page].provenance = ReadLabels(file);
    }
  }
}

void EvaluateTextures(const fs::path& found,
                      const Truth& truth,
                      const EvaluateOptions& options,
                      Evaluation& evaluation) {
  const fs::path file = found / "model.glb";
  if (!options.render || !fs::exists(file)) return;
  TexturedModel model = ReadTexturedModel(file).textured;
  ReadProvenance(found, model);
  if (!truth.surfaces_folder.empty()) {
    evaluation.texels = MeasureTexels(model, truth.surfaces_folder);
  }
  for (const NovelView& view : truth.novel_views) {
    const Image8 true_srgb8 = ReadSrgb8(view.image_file);
    const Camera camera = CameraFromTag(view.tag, true_srgb8.width, true_srgb8.height);
    evaluation.novel_views.push_back({view.name,
                                      ComparePictures(true_srgb8,
                                                      options.render(model, camera),
                                                      ReadLabels(view.faces_file),
                                                      CoveredPixels(model, camera)),
                                      std::nullopt});
  }
}

// The upper reference beside each novel view.
void EvaluateOracle(const Truth& truth, const PolygonModel& model, Evaluation& evaluation) {
  if (evaluation.novel_views.empty()) return;
  try {
    std::vector<Image8> true_srgb8;
    std::vector<Camera> cameras;
    for (const NovelView& view : truth.novel_views) {
      true_srgb8.push_back(ReadSrgb8(view.image_file));
      cameras.push_back(CameraFromTag(view.tag, true_srgb8.back().width, true_srgb8.back().height));
    }
    const std::vector<OraclePicture> pictures =
        RenderOracle(model, FindOraclePhotographs(truth), cameras);
    for (size_t i = 0; i < pictures.size(); ++i) {
      evaluation.novel_views[i].oracle =
          ComparePictures(true_srgb8[i],
                          pictures[i].srgb8,
                          ReadLabels(truth.novel_views[i].faces_file),
                          pictures[i].covered);
    }
  } catch (const Error& error) {
    evaluation.why_no_oracle = error.what();
  }
}

}  // namespace

Image8 CoveredPixels(const TexturedModel& model, const Camera& camera) {
  std::vector<TexelMap> maps;
  for (size_t face = 0; face < model.model.faces.size(); ++face) {
    maps.push_back(face < model.faces.size()
                       ? FitTexelMap(model.model, static_cast<int>(face), model.faces[face])
                       : TexelMap());
  }
  const Visibility visibility(model.model);
  const Eigen::Vector3d position = camera.PositionInWorld();
  Image8 covered(camera.width_px, camera.height_px, 1);
  tbb::parallel_for(0, camera.height_px, [&](int y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const Eigen::Vector3d direction = UnprojectToWorld(camera, {x + 0.5, y + 0.5});
      const auto hit = visibility.FirstHit(position, direction);
      if (!hit || !maps[hit->face].has_texture) continue;
      const TexturePage& page = model.pages[model.faces[hit->face].page];
      if (page.provenance.Empty()) {
        *covered.At(x, y) = 255;
        continue;
      }
      const Eigen::Vector3d point = position + hit->distance * direction;
      const Eigen::Vector2d texel = maps[hit->face].TexelAt(point);
      const int u = std::clamp(static_cast<int>(texel.x()), 0, page.provenance.width - 1);
      const int v = std::clamp(static_cast<int>(texel.y()), 0, page.provenance.height - 1);
      if (*page.provenance.At(u, v) != kProvenanceNone) *covered.At(x, y) = 255;
    }
  });
  return covered;
}

Evaluation Evaluate(const fs::path& found,
                    const Truth& truth,
                    const PolygonModel& model,
                    const EvaluateOptions& options) {
  Evaluation evaluation;
  EvaluateCameras(found, truth, model, evaluation);
  EvaluateMasks(found, truth, model, evaluation);
  EvaluateTextures(found, truth, options, evaluation);
  EvaluateOracle(truth, model, evaluation);
  return evaluation;
}

std::array<ParameterErrors, kNumCameraParameters> SummariseParameters(
    const Evaluation& evaluation) {
  std::vector<PhotographParameters> photographs;
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    if (photograph.parameters) photographs.push_back(*photograph.parameters);
  }
  return SummariseParameters(photographs);
}

}  // namespace groundglass
