// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/vertex_error.h"
#include "scene/camera.h"
#include "scene/polygon_model.h"
#include "scene/registration.h"

#include <optional>

namespace groundglass {

// A vertex error above this makes an accepted photograph a wrong one: 3 px at 640 wide.
double WrongAcceptedThresholdPx(int width_px);

// One camera against its truth, in the tag's own numbers.
struct CameraErrors {
  VertexError vertex;
  double position = 0;       // distance, model's unit
  double direction_deg = 0;  // angle between the optical axes
  // Found minus true, in the order and units of kCameraParameterNames.
  CameraParameters parameters = CameraParameters::Zero();
};
CameraErrors MeasureCameraErrors(const PolygonModel& model,
                                 const Camera& true_camera,
                                 const Camera& found_camera);

// Whether errors are as large as a covariance claims.
struct Calibration {
  double mahalanobis_squared = 0;
  int degrees_of_freedom = 0;  // parameters with a variance
  // The level, 0 to 1, of the covariance's smallest ellipsoid that holds the truth.
  double confidence = 0;
  bool is_inside_95 = false;  // of the 95 % ellipsoid
};
// Nothing if the covariance is zero. Parameters without variance are left out.
std::optional<Calibration> MeasureCalibration(const CameraParameters& errors,
                                              const CameraCovariance& covariance);

}  // namespace groundglass
