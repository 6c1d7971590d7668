// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

// Whoever looks at the model: upright, without roll.
struct Eye {
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  double yaw_deg = 90;  // of the view axis, from X (east) towards Y (north)
  double pitch_deg = 0;
  double view_angle_deg = 50;  // horizontal

  Eigen::Vector3d Forward() const;
  Eigen::Vector3d Right() const;
  Camera InFrame(int width_px, int height_px) const;

  bool operator==(const Eye&) const = default;
};

struct NavigatorOptions {
  double orbit_deg_per_px = 0.3;
  double look_deg_per_px = 0.15;
  double dolly_share = 0.15;  // of the depth under the cursor, for each notch
  double max_pitch_deg = 89;
  double eye_height_m = 1.6;   // when walking
  double step_height_m = 0.6;  // what a person climbs in one step
  double framing = 1.15;       // room around what is framed

  void Check() const;  // throws Error naming the first field out of range
};

// Each gives the eye after a gesture; angles and ways as the hand moved, right and down positive.

// Turns about a point, which stays where it is in the picture's depth (a turntable).
Eye Orbit(const Eye& eye,
          const Eigen::Vector3d& about_in_world,
          double right_px,
          double down_px,
          const NavigatorOptions& options = {});
// Turns where it stands.
Eye LookAround(const Eye& eye,
               double right_px,
               double down_px,
               const NavigatorOptions& options = {});
// Moves across, so that what is at this depth follows the hand. frame_width_px: of the picture.
Eye Pan(const Eye& eye, double depth, double right_px, double down_px, int frame_width_px);
// Towards a point, for each notch by a share of what is left; never through it.
Eye Dolly(const Eye& eye,
          const Eigen::Vector3d& towards_in_world,
          double notches,
          const NavigatorOptions& options = {});
// Along its own axes, by lengths in the model's unit.
Eye Fly(const Eye& eye, double forward, double right, double up);
// As Fly, on the ground: level, at eye height above what is underfoot (the model's faces, else the
// height of its lowest point), up and down steps; a wall is not walked through.
Eye Walk(const Eye& eye,
         const PolygonModel& model,
         const Visibility& visibility,
         double forward,
         double right,
         const NavigatorOptions& options = {});
// Looks from where it looks now, so far away that the box fills the picture.
Eye FrameBox(const Eye& eye, const Box& box, double aspect, const NavigatorOptions& options = {});
// Where the model is first looked at from: the south-west, from above.
Eye FirstEye(const PolygonModel& model, double aspect, const NavigatorOptions& options = {});
// The upright eye that stands and looks as a camera does; its roll and lens are left behind.
Eye EyeOf(const Camera& camera);
// Between two eyes, share from 0 to 1; yaw by the shorter way.
Eye Between(const Eye& from, const Eye& to, double share);

}  // namespace groundglass
