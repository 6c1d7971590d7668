// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <Eigen/Dense>

namespace groundglass {

// How other programs tell the same camera. This is the one home of these rules: a format's file
// asks here and converts nothing by itself.

// The axes of OpenGL, Blender, nerfstudio, fSpy and MeshLab: x right, y up, z backwards. The same
// matrix leads from `cam` and back.
inline Eigen::Matrix3d GlFromCam() { return Eigen::Vector3d(1, -1, -1).asDiagonal(); }

// Where such a camera stands and how it is turned, camera to world: [R' G | C].
Eigen::Matrix4d WorldFromGlCam(const Camera& camera);
// Throws Error as NearestRotation does.
void SetPoseFromGlCam(const Eigen::Matrix4d& world_from_gl_cam, Camera& camera);

// The rotation that a file's matrix means: its numbers are rounded, and it may be scaled, which
// directions are not. Throws Error for one that mirrors, or that changes angles.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix);

// The angles that RealityCapture turns a camera by, degrees: with its axes as OpenGL's, camera to
// world is Rz(-heading) Rx(pitch) Ry(roll); pitch is 90 for a level view, from -90 to 90. There,
// where heading and roll are one, roll is 0.
struct HeadingPitchRoll {
  double heading_deg = 0;
  double pitch_deg = 0;
  double roll_deg = 0;
};
HeadingPitchRoll HeadingPitchRollOf(const Camera& camera);

// Sets the picture's size. Throws Error where it cannot be one (scene/camera_check.h).
void SetSize(double width_px, double height_px, Camera& camera);

// The principal point, which is (cx, cy) from the picture's top-left corner here, where other
// programs count it from:

// The middle of the picture, right and down, px (Metashape).
Eigen::Vector2d CenterFromMiddle(const Camera& camera);
void SetCenterFromMiddle(const Eigen::Vector2d& from_middle_px, Camera& camera);
// The lower left corner, px, y up (MeshLab).
Eigen::Vector2d CenterFromBelow(const Camera& camera);
void SetCenterFromBelow(const Eigen::Vector2d& from_below_px, Camera& camera);
// The picture's middle, on an image plane whose longer side reaches from -1 to 1, y up (fSpy).
Eigen::Vector2d CenterOnImagePlane(const Camera& camera);
void SetCenterOnImagePlane(const Eigen::Vector2d& on_plane, Camera& camera);
// As shares of width and height from the top-left corner (mvs-texturing).
Eigen::Vector2d CenterAsShare(const Camera& camera);
// Blender moves the frame and not the centre, in shares of the width; y also counts in pixels of
// the width's kind where they are oblong.
Eigen::Vector2d BlenderShift(const Camera& camera);

// The angles from the axis to the frame's sides as seen by a camera without distortion, degrees;
// to the left and below they are negative.
struct FieldOfView {
  double left_deg = 0;
  double right_deg = 0;
  double bottom_deg = 0;
  double top_deg = 0;
};
FieldOfView FieldOfViewOf(const Camera& camera);

}  // namespace groundglass
