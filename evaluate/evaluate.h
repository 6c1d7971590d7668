// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "evaluate/camera_errors.h"
#include "evaluate/parameter_errors.h"
#include "evaluate/picture_measures.h"
#include "evaluate/texel_errors.h"
#include "evaluate/truth.h"
#include "scene/polygon_model.h"
#include "scene/registration.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph's camera as found, against its truth (measures: docs/synthetic.md).
struct PhotographEvaluation {
  std::string name;
  CameraErrors errors;
  // Where registration.json tells them: verdict, claimed standard deviations (order and units of
  // kCameraParameterNames), and whether the truth lies inside the covariance's 95 % ellipsoid.
  std::optional<Verdict> verdict;
  std::optional<double> start_px;  // vertex error of the tag as measured
  std::optional<CameraParameters> sigmas;
  std::optional<Calibration> calibration;
  std::optional<PhotographParameters> parameters;  // of those that are not rejected
  bool is_wrong_accepted = false;
};

struct ErrorSummary {
  int count = 0;
  double mean_px = 0;
  double median_px = 0;
  double max_px = 0;
};

struct NovelViewEvaluation {
  std::string name;
  PictureErrors errors;
  std::optional<PictureErrors> oracle;  // of the best that the photographs allow (oracle.h)
};

struct Evaluation {
  std::vector<PhotographEvaluation> photographs;
  std::vector<std::string> missing;  // photographs with a true camera and no found one
  ErrorSummary all;
  ErrorSummary accepted;  // of those with a verdict
  int num_wrong_accepted = 0;
  int num_inside_95 = 0;  // of num_calibrated
  int num_calibrated = 0;
  // Automatic masks against the true ones over all photographs; empty if there are none.
  std::vector<MaskOverlap> faces;
  std::vector<NovelViewEvaluation> novel_views;
  std::string why_no_oracle;  // if novel views were judged without one
  std::optional<TexelErrors> texels;
};

struct EvaluateOptions {
  // How a textured model is drawn; what has no texture may have any colour. Textures are not
  // judged if empty.
  std::function<Image8(const TexturedModel&, const Camera&)> render;
};

// Judges `found`: an output folder, a folder of .view files, or a COLMAP text model. Whatever of
// views, registration.json, faces/ and model.glb is there is judged. Throws Error.
Evaluation Evaluate(const std::filesystem::path& found,
                    const Truth& truth,
                    const PolygonModel& model,
                    const EvaluateOptions& options = {});

// Which pixels of a view of the textured model show a texel that some photograph gave (255), by
// its pages' provenance, or by faces having texture where pages have none: 1 channel.
Image8 CoveredPixels(const TexturedModel& model, const Camera& camera);

// The errors of each number, over all photographs whose claims are known.
std::array<ParameterErrors, kNumCameraParameters> SummariseParameters(const Evaluation& evaluation);

// For people, and for programs.
std::string FormatEvaluationTable(const Evaluation& evaluation, const PolygonModel& model);
std::string FormatEvaluationJson(const Evaluation& evaluation, const PolygonModel& model);

}  // namespace groundglass
