// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/navigator.h"

#include "scene/building_bounds.h"
#include "scene/check_option.h"
#include "scene/view_tag.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

double Clamped(double pitch_deg, const NavigatorOptions& options) {
  return std::clamp(pitch_deg, -options.max_pitch_deg, options.max_pitch_deg);
}

double LowestPoint(const PolygonModel& model) { return ComputeBounds(model).min.z(); }

// The height of what a person who stands about here has underfoot.
double GroundHeight(const PolygonModel& model,
                    const Visibility& visibility,
                    const Eigen::Vector3d& knee_in_world) {
  const auto hit = visibility.FirstHit(knee_in_world, -Eigen::Vector3d::UnitZ());
  const double lowest = LowestPoint(model);
  return hit ? std::max(lowest, knee_in_world.z() - hit->distance) : lowest;
}

}  // namespace

Eigen::Vector3d Eye::Forward() const {
  const double yaw = RadiansFromDegrees(yaw_deg);
  const double pitch = RadiansFromDegrees(pitch_deg);
  return {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
}

Eigen::Vector3d Eye::Right() const {
  const double yaw = RadiansFromDegrees(yaw_deg);
  return {std::sin(yaw), -std::cos(yaw), 0};
}

Camera Eye::InFrame(int width_px, int height_px) const {
  ViewTag tag;
  tag.position_in_site = SiteFromWorld(position_in_world);
  tag.lookat_in_site = SiteFromWorld(position_in_world + Forward());
  tag.aspect = static_cast<double>(width_px) / height_px;
  tag.view_angle_deg = view_angle_deg;
  return CameraFromTag(tag, width_px, height_px);
}

void NavigatorOptions::Check() const {
  const std::string name = "navigator options: ";
  CheckAbove(orbit_deg_per_px, 0, name + "orbit_deg_per_px");
  CheckAbove(look_deg_per_px, 0, name + "look_deg_per_px");
  CheckFromTo(dolly_share, 0.001, 0.9, name + "dolly_share");
  CheckFromTo(max_pitch_deg, 1, 89.9, name + "max_pitch_deg");
  CheckAbove(eye_height_m, 0, name + "eye_height_m");
  CheckAbove(step_height_m, 0, name + "step_height_m");
  CheckAtLeast(framing, 1, name + "framing");
}

Eye Orbit(const Eye& eye,
          const Eigen::Vector3d& about_in_world,
          double right_px,
          double down_px,
          const NavigatorOptions& options) {
  Eye turned = LookAround(eye, 0, 0, options);
  turned.yaw_deg = eye.yaw_deg - right_px * options.orbit_deg_per_px;
  turned.pitch_deg = Clamped(eye.pitch_deg - down_px * options.orbit_deg_per_px, options);
  // The point keeps its place in the eye's own axes.
  const auto axes = [](const Eye& of) {
    Eigen::Matrix3d columns;
    columns << of.Right(), of.Right().cross(of.Forward()), of.Forward();
    return columns;
  };
  const Eigen::Vector3d in_eye = axes(eye).transpose() * (about_in_world - eye.position_in_world);
  turned.position_in_world = about_in_world - axes(turned) * in_eye;
  return turned;
}

Eye LookAround(const Eye& eye, double right_px, double down_px, const NavigatorOptions& options) {
  Eye turned = eye;
  turned.yaw_deg -= right_px * options.look_deg_per_px;
  turned.pitch_deg = Clamped(eye.pitch_deg - down_px * options.look_deg_per_px, options);
  return turned;
}

Eye Pan(const Eye& eye, double depth, double right_px, double down_px, int frame_width_px) {
  const double length_per_px =
      2 * depth * std::tan(RadiansFromDegrees(eye.view_angle_deg) / 2) / frame_width_px;
  Eye moved = eye;
  const Eigen::Vector3d up = eye.Right().cross(eye.Forward());
  moved.position_in_world += length_per_px * (-right_px * eye.Right() + down_px * up);
  return moved;
}

Eye Dolly(const Eye& eye,
          const Eigen::Vector3d& towards_in_world,
          double notches,
          const NavigatorOptions& options) {
  Eye moved = eye;
  moved.position_in_world = towards_in_world + (eye.position_in_world - towards_in_world) *
                                                   std::pow(1 - options.dolly_share, notches);
  return moved;
}

Eye Fly(const Eye& eye, double forward, double right, double up) {
  Eye moved = eye;
  moved.position_in_world +=
      forward * eye.Forward() + right * eye.Right() + up * Eigen::Vector3d::UnitZ();
  return moved;
}

Eye Walk(const Eye& eye,
         const PolygonModel& model,
         const Visibility& visibility,
         double forward,
         double right,
         const NavigatorOptions& options) {
  const double unit_per_metre = 1 / MetresPerUnit(model.unit);
  const double eye_height = options.eye_height_m * unit_per_metre;
  const double step_height = options.step_height_m * unit_per_metre;
  const double yaw = RadiansFromDegrees(eye.yaw_deg);
  const Eigen::Vector3d way =
      forward * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0) + right * eye.Right();
  Eye moved = eye;
  const double ground = GroundHeight(model, visibility, eye.position_in_world);
  const double length = way.norm();
  if (length > 0) {
    // What stands higher than a step is a wall, and half a step is kept from it.
    const Eigen::Vector3d knee(
        eye.position_in_world.x(), eye.position_in_world.y(), ground + step_height);
    const auto wall = visibility.FirstHit(knee, way / length, 0, length + step_height / 2);
    const double free = wall ? std::max(0.0, wall->distance - step_height / 2) : length;
    moved.position_in_world += way / length * std::min(length, free);
  }
  const Eigen::Vector3d knee(
      moved.position_in_world.x(), moved.position_in_world.y(), ground + step_height);
  moved.position_in_world.z() = GroundHeight(model, visibility, knee) + eye_height;
  return moved;
}

Eye FrameBox(const Eye& eye, const Box& box, double aspect, const NavigatorOptions& options) {
  const double half_width = std::tan(RadiansFromDegrees(eye.view_angle_deg) / 2);
  const double narrower = std::min(half_width, half_width / aspect);
  Eye framed = eye;
  const double distance = options.framing * box.Diagonal() / 2 / std::sin(std::atan(narrower));
  framed.position_in_world = box.Center() - distance * eye.Forward();
  return framed;
}

Eye FirstEye(const PolygonModel& model, double aspect, const NavigatorOptions& options) {
  Eye eye;
  eye.yaw_deg = 55;
  eye.pitch_deg = -22;
  return FrameBox(eye, ComputeBuildingBounds(model), aspect, options);
}

Eye EyeOf(const Camera& camera) {
  Eye eye;
  eye.position_in_world = camera.PositionInWorld();
  const Eigen::Vector3d forward = camera.ForwardInWorld();
  eye.yaw_deg = DegreesFromRadians(std::atan2(forward.y(), forward.x()));
  eye.pitch_deg = DegreesFromRadians(std::asin(std::clamp(forward.z(), -1.0, 1.0)));
  eye.view_angle_deg = DegreesFromRadians(2 * std::atan(camera.width_px / (2 * camera.focal_x_px)));
  return eye;
}

Eye Between(const Eye& from, const Eye& to, double share) {
  Eye eye;
  eye.position_in_world =
      from.position_in_world + share * (to.position_in_world - from.position_in_world);
  const double turn = std::remainder(to.yaw_deg - from.yaw_deg, 360.0);
  eye.yaw_deg = from.yaw_deg + share * turn;
  eye.pitch_deg = from.pitch_deg + share * (to.pitch_deg - from.pitch_deg);
  eye.view_angle_deg = from.view_angle_deg + share * (to.view_angle_deg - from.view_angle_deg);
  return eye;
}

}  // namespace groundglass
