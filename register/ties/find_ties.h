// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/tie_points.h"

namespace groundglass {

// All that ties the views together through their present cameras, from whatever the options say:
// patches of faces that are compared (FindTiePoints), keypoints that were followed (PlaceTracks).
TiePoints FindTies(const PolygonModel& model,
                   const Visibility& visibility,
                   const std::vector<TieView>& views,
                   const TieOptions& options);

// The same between one view and the others only.
TiePoints FindTiesOf(int photograph,
                     const PolygonModel& model,
                     const Visibility& visibility,
                     const std::vector<TieView>& views,
                     const TieOptions& options);

}  // namespace groundglass
