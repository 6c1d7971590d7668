// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <string>
#include <utility>
#include <vector>

namespace groundglass {

struct CovisibleOptions {
  // Places are looked at through a grid of this many columns,
  int grid_columns = 12;
  // and two photographs are a pair if this share of the places on the model that one of them sees
  // is seen by the other.
  double least_share = 0.1;
  // Faces that a camera sees further than this from square on do not count for it.
  double max_angle_deg = 80;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "covisible options: ") const;
};

// Cameras that see the same places on the same faces: pairs of their numbers, the lower first, in
// order. The same whatever the number of threads.
std::vector<std::pair<int, int>> FindCovisiblePairs(const PolygonModel& model,
                                                    const Visibility& visibility,
                                                    const std::vector<Camera>& cameras,
                                                    const CovisibleOptions& options);

}  // namespace groundglass
