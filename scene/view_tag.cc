// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/view_tag.h"

#include "scene/frames.h"
#include "scene/text.h"

#include <cassert>
#include <cmath>

namespace groundglass {
namespace {

// Closer than this to the vertical (radians) yaw has no meaning: closer than any notebook.
constexpr double kSteepest = 1e-6;

}  // namespace

double GetTagValue(const ViewTag& tag, TagKey key) {
  switch (key) {
    case TagKey::kX:
      return tag.position_in_site.x();
    case TagKey::kY:
      return tag.position_in_site.y();
    case TagKey::kZ:
      return tag.position_in_site.z();
    case TagKey::kI:
      return tag.lookat_in_site.x();
    case TagKey::kJ:
      return tag.lookat_in_site.y();
    case TagKey::kK:
      return tag.lookat_in_site.z();
    case TagKey::kA:
      return tag.aspect;
    case TagKey::kV:
      return tag.view_angle_deg;
    case TagKey::kRoll:
      return tag.roll_deg;
    case TagKey::kShiftX:
      return tag.shift_x;
    case TagKey::kShiftY:
      return tag.shift_y;
    case TagKey::kK1:
      return tag.k1;
    case TagKey::kK2:
      return tag.k2;
    case TagKey::kK3:
      return tag.k3;
    case TagKey::kP1:
      return tag.p1;
    case TagKey::kP2:
      return tag.p2;
  }
  return 0;
}

void SetTagValue(ViewTag& tag, TagKey key, double value) {
  switch (key) {
    case TagKey::kX:
      tag.position_in_site.x() = value;
      return;
    case TagKey::kY:
      tag.position_in_site.y() = value;
      return;
    case TagKey::kZ:
      tag.position_in_site.z() = value;
      return;
    case TagKey::kI:
      tag.lookat_in_site.x() = value;
      return;
    case TagKey::kJ:
      tag.lookat_in_site.y() = value;
      return;
    case TagKey::kK:
      tag.lookat_in_site.z() = value;
      return;
    case TagKey::kA:
      tag.aspect = value;
      return;
    case TagKey::kV:
      tag.view_angle_deg = value;
      return;
    case TagKey::kRoll:
      tag.roll_deg = value;
      return;
    case TagKey::kShiftX:
      tag.shift_x = value;
      return;
    case TagKey::kShiftY:
      tag.shift_y = value;
      return;
    case TagKey::kK1:
      tag.k1 = value;
      return;
    case TagKey::kK2:
      tag.k2 = value;
      return;
    case TagKey::kK3:
      tag.k3 = value;
      return;
    case TagKey::kP1:
      tag.p1 = value;
      return;
    case TagKey::kP2:
      tag.p2 = value;
      return;
  }
}

Camera CameraFromTag(const ViewTag& tag, int width_px, int height_px) {
  assert(!FindTagFault(tag));
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  const double width = width_px;
  const double height = height_px;
  camera.focal_x_px = (width / 2) / std::tan(RadiansFromDegrees(tag.view_angle_deg) / 2);
  camera.focal_y_px = camera.focal_x_px * tag.aspect * height / width;
  camera.center_x_px = width / 2 + tag.shift_x * width;
  camera.center_y_px = height / 2 + tag.shift_y * camera.focal_y_px / camera.focal_x_px * width;
  camera.k1 = tag.k1;
  camera.k2 = tag.k2;
  camera.k3 = tag.k3;
  camera.p1 = tag.p1;
  camera.p2 = tag.p2;

  const Eigen::Vector3d position = WorldFromSite(tag.position_in_site);
  const Eigen::Vector3d forward = (WorldFromSite(tag.lookat_in_site) - position).normalized();
  const Eigen::Vector3d level_right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d level_down = forward.cross(level_right);
  const double cos_roll = std::cos(RadiansFromDegrees(tag.roll_deg));
  const double sin_roll = std::sin(RadiansFromDegrees(tag.roll_deg));
  Eigen::Matrix3d& rotation = camera.cam_from_world.rotation;
  rotation.row(0) = cos_roll * level_right + sin_roll * level_down;
  rotation.row(1) = -sin_roll * level_right + cos_roll * level_down;
  rotation.row(2) = forward;
  camera.cam_from_world.translation = -(rotation * position);
  return camera;
}

ViewTag TagFromCamera(const Camera& camera, double lookat_distance) {
  ViewTag tag;
  const Eigen::Vector3d position = camera.PositionInWorld();
  Eigen::Vector3d forward = camera.ForwardInWorld();
  if (forward.head<2>().norm() < 1.5 * kSteepest) {
    // Towards where the picture's top points, or away from it in a view up: down stays level.
    const Eigen::Vector3d up = -camera.cam_from_world.rotation.row(1).transpose();
    const Eigen::Vector3d level(up.x(), up.y(), 0);
    forward = (forward + 2 * kSteepest * (forward.z() < 0 ? level : -level)).normalized();
  }
  tag.position_in_site = SiteFromWorld(position);
  tag.lookat_in_site = SiteFromWorld(position + lookat_distance * forward);
  tag.view_angle_deg = DegreesFromRadians(2 * std::atan(camera.width_px / (2 * camera.focal_x_px)));
  tag.aspect = camera.focal_y_px * camera.width_px / (camera.focal_x_px * camera.height_px);
  const Eigen::Vector3d level_right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d level_down = forward.cross(level_right);
  const Eigen::Vector3d right = camera.cam_from_world.rotation.row(0).transpose();
  tag.roll_deg = DegreesFromRadians(std::atan2(right.dot(level_down), right.dot(level_right)));
  tag.shift_x = camera.center_x_px / camera.width_px - 0.5;
  tag.shift_y = (camera.center_y_px - camera.height_px / 2.0) * camera.focal_x_px /
                (camera.focal_y_px * camera.width_px);
  tag.k1 = camera.k1;
  tag.k2 = camera.k2;
  tag.k3 = camera.k3;
  tag.p1 = camera.p1;
  tag.p2 = camera.p2;
  return tag;
}

namespace {

// Beyond these a number was not meant: the earth's girth in millimetres, a panorama, a small part
// of a picture. Where a lens shows little, its higher coefficients are large.
constexpr double kLargestCoordinate = 5e10;
constexpr double kLargestAspect = 1e6;
constexpr double kLargestShift = 100;
constexpr double kLargestDistortion = 1e9;
// Nor a deviation, in the model's unit and of what is about 1 or less: it says nothing.
constexpr double kLargestLengthSigma = 1e7;
constexpr double kLargestShareSigma = 100;

std::optional<TagFault> FindDistortionFault(const ViewTag& tag) {
  for (const TagKey key : {TagKey::kK1, TagKey::kK2, TagKey::kK3, TagKey::kP1, TagKey::kP2}) {
    if (std::abs(GetTagValue(tag, key)) <= kLargestDistortion) continue;
    return TagFault{std::string(kTagKeyNames[static_cast<size_t>(key)]),
                    "no lens has a distortion of " + FormatNumber(GetTagValue(tag, key)) +
                        "; leave it out if it is not known"};
  }
  return std::nullopt;
}

}  // namespace

std::string FindSigmaFault(const SigmaKey& key, double sigma) {
  if (!(sigma > 0)) return "a standard deviation must be above 0";
  double largest = kLargestLengthSigma;
  if (key.member == &TagSigmas::roll_deg || key.member == &TagSigmas::view_angle_deg) largest = 360;
  if (key.member == &TagSigmas::aspect || key.member == &TagSigmas::shift ||
      key.member == &TagSigmas::k1) {
    largest = kLargestShareSigma;
  }
  if (sigma <= largest) return "";
  return "a standard deviation of " + FormatNumber(sigma) + " says nothing; expected " +
         FormatNumber(largest) + " or less, or leave it out";
}

std::optional<TagFault> FindTagFault(const ViewTag& tag) {
  for (int index = 0; index < kNumTagKeys; ++index) {
    if (!std::isfinite(GetTagValue(tag, static_cast<TagKey>(index)))) {
      return TagFault{std::string(kTagKeyNames[index]), "must be a finite number"};
    }
  }
  for (const TagKey key :
       {TagKey::kX, TagKey::kY, TagKey::kZ, TagKey::kI, TagKey::kJ, TagKey::kK}) {
    if (std::abs(GetTagValue(tag, key)) > kLargestCoordinate) {
      return TagFault{std::string(kTagKeyNames[static_cast<size_t>(key)]),
                      "no place on earth has a coordinate of " +
                          FormatNumber(GetTagValue(tag, key)) + "; is there a digit too many?"};
    }
  }
  if (!(tag.view_angle_deg > 0 && tag.view_angle_deg < 180)) {
    return TagFault{"v",
                    "view angle must lie between 0 and 180 degrees; of a lens of f mm before 35 mm "
                    "film it is 2 atan(18 / f)"};
  }
  if (!(tag.aspect > 0)) return TagFault{"a", "aspect (width / height) must be above 0"};
  if (tag.aspect > kLargestAspect || tag.aspect < 1 / kLargestAspect) {
    return TagFault{"a",
                    "aspect is width / height of the frame, 1.5 for a slide; no frame has this"};
  }
  if (std::abs(tag.roll_deg) > 360) {
    return TagFault{"roll", "expected degrees, from -360 to 360"};
  }
  for (const TagKey key : {TagKey::kShiftX, TagKey::kShiftY}) {
    if (std::abs(GetTagValue(tag, key)) > kLargestShift) {
      return TagFault{std::string(kTagKeyNames[static_cast<size_t>(key)]),
                      "expected a share of the frame's width, 0.02 for a fiftieth"};
    }
  }
  if (std::optional<TagFault> fault = FindDistortionFault(tag)) return fault;
  const Eigen::Vector3d axis = tag.lookat_in_site - tag.position_in_site;
  const double distance = axis.norm();
  if (!(distance > 0)) {
    return TagFault{"i", "look-at point is the camera's own position, so it gives no direction"};
  }
  if (axis.head<2>().norm() < kSteepest * distance) {
    return TagFault{"k", "view is straight up or down, where yaw has no meaning"};
  }
  return std::nullopt;
}

}  // namespace groundglass
