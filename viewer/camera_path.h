// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/formats/image_io.h"
#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

// The camera for a frame of another shape: the horizontal view is kept, pixels become square, the
// principal point keeps its place relative to the frame's middle, and the picture gains or loses at
// top and bottom.
Camera ReframedCamera(const Camera& camera, int width_px, int height_px);

// The camera for a frame of another shape or size that holds all that its own frame holds, as large
// as it goes; pixels become square, the principal point keeps its place relative to the middle.
Camera FittedCamera(const Camera& camera, int width_px, int height_px);

// The frame that most of the cameras have; of several, the largest. 0 x 0 without cameras.
ImageSize CommonFrame(const std::vector<Camera>& cameras);

// A smooth flight through the cameras, in order: Catmull-Rom through positions and lenses, the
// same construction with slerp in place of lerp through rotations, at an even pace that starts and
// ends gently. First and last frame are the first and last camera. If all cameras stand outside the
// model's bounding box the way leads around it, by the shorter side, and keeps it in sight;
// otherwise straight from camera to camera. All frames have the size that most cameras have
// (CommonFrame); the others' views are fitted into it. Error if there are no cameras, or fewer than
// one frame.
//
// Catmull and Rom 1974; centripetal knots: Yuksel, Schaefer and Keyser 2011; the pyramid on the
// sphere: Schlag, Graphics Gems II, 1991.
std::vector<Camera> MakeFlight(const PolygonModel& model,
                               const std::vector<Camera>& views,
                               int num_frames);

struct OrbitOptions {
  int width_px = 1280;
  int height_px = 720;
  double view_angle_deg = 45;      // horizontal
  double height_deg = 18;          // of the camera above the model's middle, as seen from there
  double first_bearing_deg = 180;  // where the camera first stands: 180 is to the south
  void Check() const;              // throws Error naming the first field out of range
};

// Once around the model, clockwise seen from above, always looking at its middle; the whole model
// stays in the frame. The frame after the last would be the first again.
std::vector<Camera> MakeOrbit(const PolygonModel& model,
                              int num_frames,
                              const OrbitOptions& options = {});

}  // namespace groundglass
