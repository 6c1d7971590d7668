// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/tie_points.h"

#include <vector>

namespace groundglass {

// Tie points from keypoints that were followed through the photographs (TieView::followed), all
// views' from the same tracks. Each is placed on the face that most of its rays meet first through
// the present cameras; a keypoint whose ray meets another plane, or that the place cannot explain
// (TrackOptions::gate_...), is left out, and a track of which fewer than two are left is none. The
// same whatever the number of threads.
TiePoints PlaceTracks(const PolygonModel& model,
                      const Visibility& visibility,
                      const std::vector<TieView>& views,
                      const TrackOptions& options);

// The same of the tracks that one view shows only.
TiePoints PlaceTracksOf(int photograph,
                        const PolygonModel& model,
                        const Visibility& visibility,
                        const std::vector<TieView>& views,
                        const TrackOptions& options);

}  // namespace groundglass
