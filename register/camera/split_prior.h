// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"

#include <array>

namespace groundglass {

// What the photographs of one lens may share.
constexpr std::array<CameraParameter, 5> kLensParameters = {
    kViewAngle, kAspect, kShiftX, kShiftY, kK1};
constexpr int kNumLensParameters = static_cast<int>(kLensParameters.size());
using LensParameters = Eigen::Matrix<double, kNumLensParameters, 1>;

// A camera's prior in two parts: the photograph's own, and its lens'. Both blocks are whitened.
struct SplitPrior {
  CameraPrior whole;
  CameraCovariance own_root = CameraCovariance::Zero();
  Eigen::Matrix<double, kNumCameraParameters, kNumLensParameters> lens_root =
      Eigen::Matrix<double, kNumCameraParameters, kNumLensParameters>::Zero();
  // Back to the undivided prior's whitened parameters: whole_from_parts * (own; lens).
  Eigen::Matrix<double, kNumCameraParameters, kNumCameraParameters + kNumLensParameters>
      whole_from_parts;

  ParameterProjection ProjectionAt(const CameraParameters& own, const LensParameters& lens) const {
    return {whole.mean + own_root * own + lens_root * lens,
            TagDistortion(whole.measured),
            whole.width_px,
            whole.height_px};
  }
};

// own_shares: of each lens parameter's variance, the part that is the photograph's own, in (0, 1].
SplitPrior SplitIntoOwnAndLens(const CameraPrior& prior, const LensParameters& own_shares);

}  // namespace groundglass
