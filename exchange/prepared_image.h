// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"

namespace groundglass {

// What a format cannot hold, so that the picture must be changed to do without.
struct CameraNeeds {
  bool no_distortion = false;
  bool square_pixels = false;
  bool centred = false;  // the principal point in the picture's middle
};

// The nearest camera that a format can hold: a frame that shows all that the camera's own shows,
// no coarser than it. Equal to the camera where nothing is needed. Throws Error where that frame
// would be larger than a picture can be.
Camera PreparedCamera(const Camera& camera, const CameraNeeds& needs);
bool IsSameFrame(const Camera& a, const Camera& b);

// The picture resampled for it (bilinear, in linear light), black where the camera shows nothing;
// and a mask of one channel, 255 where it does.
struct PreparedImage {
  Image8 srgb8;
  Image8 mask;
};
PreparedImage PrepareImage(const Image8& srgb8, const Camera& camera, const Camera& prepared);

}  // namespace groundglass
