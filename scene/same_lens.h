// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/view_tag.h"

#include <string>
#include <tuple>

namespace groundglass {

// What photographs that one lens took have in common: its name and the picture's shape (one of
// another shape is turned or cropped), else size, view angle and aspect.
using LensIdentity = std::tuple<std::string, int, int, double, double>;

inline LensIdentity LensIdentityOf(const ViewTag& tag, int width_px, int height_px) {
  if (!tag.camera.empty()) return {tag.camera, 1000 * width_px / height_px, 0, 0, 0};
  return {"", width_px, height_px, tag.view_angle_deg, tag.aspect};
}

}  // namespace groundglass
