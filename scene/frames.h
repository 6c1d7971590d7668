// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

namespace groundglass {

// Frames (docs/frames.md):
//   site   LEFT-handed: x east, y south, z up. What people write: .view and .osu files.
//   world  right-handed: X east, Y north, Z up. Everything in memory.
//   cam    right-handed: x right, y down, z forward.
//   image  pixels; origin at the top-left corner, so the first pixel's centre is (0.5, 0.5).
// Lengths stay in the model's unit in all of them.

// site <-> world is a reflection: its own inverse, with determinant -1. No rotation expresses it,
// so it is a function here and never a RigidTransform.
inline Eigen::Vector3d WorldFromSite(const Eigen::Vector3d& point_in_site) {
  return {point_in_site.x(), -point_in_site.y(), point_in_site.z()};
}
inline Eigen::Vector3d SiteFromWorld(const Eigen::Vector3d& point_in_world) {
  return {point_in_world.x(), -point_in_world.y(), point_in_world.z()};
}

// A rotation and a translation, named b_from_a: point_in_b = rotation * point_in_a + translation.
struct RigidTransform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point_in_a) const {
    return rotation * point_in_a + translation;
  }
};

// c_from_a = c_from_b * b_from_a
inline RigidTransform operator*(const RigidTransform& c_from_b, const RigidTransform& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation,
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

// a_from_b for a b_from_a.
inline RigidTransform Inverse(const RigidTransform& b_from_a) {
  return {b_from_a.rotation.transpose(), -(b_from_a.rotation.transpose() * b_from_a.translation)};
}

constexpr double kDegreesPerRadian = 57.295779513082320876798;
inline double RadiansFromDegrees(double angle_deg) { return angle_deg / kDegreesPerRadian; }
inline double DegreesFromRadians(double angle_rad) { return angle_rad * kDegreesPerRadian; }

constexpr double kMetresPerFoot = 0.3048;

}  // namespace groundglass
