// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera_check.h"

#include "scene/text.h"

#include <cmath>

namespace groundglass {
namespace {

bool IsSide(double px) { return px >= 1 && px <= kLongestSidePx && px == std::floor(px); }

// "3", "1e+300", "not a number"
std::string InWords(double value) {
  return std::isnan(value) ? "not a number" : std::isinf(value) ? "infinite" : FormatNumber(value);
}

bool IsRotation(const Eigen::Matrix3d& matrix) {
  return (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         matrix.determinant() > 0;
}

// As some programs count them: a focal length of few pixels, about a point within the first pixel.
bool AreSharesOfWidth(const Camera& camera) {
  constexpr double kLongestFocal = 10;      // a telescope's, as a share of the width
  constexpr double kNarrowestPicture = 64;  // px; smaller ones may have so short a focal length
  const auto is_share = [](double center) { return center > 0 && center <= 1; };
  return camera.width_px >= kNarrowestPicture && camera.focal_x_px < kLongestFocal &&
         camera.focal_y_px < kLongestFocal && is_share(camera.center_x_px) &&
         is_share(camera.center_y_px);
}

}  // namespace

std::string FindSizeFault(double width_px, double height_px) {
  if (IsSide(width_px) && IsSide(height_px)) return {};
  return "an image of " + InWords(width_px) + " x " + InWords(height_px) +
         " pixels cannot be; expected whole numbers from 1 to " + std::to_string(kLongestSidePx);
}

std::string FindCameraFault(const Camera& camera) {
  std::string size_fault = FindSizeFault(camera.width_px, camera.height_px);
  if (!size_fault.empty()) return size_fault;
  for (const double focal_px : {camera.focal_x_px, camera.focal_y_px}) {
    if (focal_px > 0 && std::isfinite(focal_px)) continue;
    return "the focal length must be above 0 and finite; here it is " + InWords(focal_px);
  }
  if (AreSharesOfWidth(camera)) {
    return "the focal length " + InWords(camera.focal_x_px) + " and the principal point " +
           InWords(camera.center_x_px) + ", " + InWords(camera.center_y_px) +
           " are shares of the picture's sides, it seems, and would be a view angle of nearly 180 "
           "degrees; expected pixels: multiply them by " +
           InWords(camera.width_px) + " (and what counts downwards by " +
           InWords(camera.height_px) + " if it is a share of the height)";
  }
  for (const double center_px : {camera.center_x_px, camera.center_y_px}) {
    if (std::abs(center_px) <= kLongestSidePx) continue;
    return "the principal point must lie within " + std::to_string(kLongestSidePx) +
           " pixels of the picture's corner; here it is at " + InWords(camera.center_x_px) + ", " +
           InWords(camera.center_y_px);
  }
  for (const double term : {camera.k1, camera.k2, camera.k3, camera.p1, camera.p2}) {
    if (!std::isfinite(term))
      return "a term of the lens must be finite; here it is " + InWords(term);
  }
  if (!camera.cam_from_world.translation.allFinite()) {
    return "the camera's place must be three finite numbers";
  }
  if (!camera.cam_from_world.rotation.allFinite() || !IsRotation(camera.cam_from_world.rotation)) {
    return "the camera's direction is no rotation";
  }
  return {};
}

}  // namespace groundglass
