// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <string>

namespace groundglass {

// Faults of a face that make it unusable, and oddities worth a warning; shared by all readers.
struct FaceCheck {
  std::string fault;              // empty if usable
  std::string warning;            // empty if planar within 0.1 % of its size
  double out_of_plane_share = 0;  // of its size; 0 if it cannot be used
};
FaceCheck CheckFace(const PolygonModel& model, int face);

}  // namespace groundglass
