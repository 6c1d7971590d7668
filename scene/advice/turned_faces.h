// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/scene.h"
#include "scene/polygon_model.h"

#include <string>
#include <vector>

namespace groundglass {

// A face whose points run the wrong way round, among others that do not.
struct TurnedFace {
  int face = -1;            // from 0
  int num_photographs = 0;  // that see its back
};

// By the tags as they are: faces whose backs lie free before photographs and whose fronts are seen
// by none, if their neighbours or the building around their fronts tell that they are turned.
std::vector<TurnedFace> FindTurnedFaces(const Scene& scene);

// "face 3 (east gable) is seen from its back in 3 photographs; its front is never seen".
std::string DescribeTurnedFace(const PolygonModel& model, const TurnedFace& turned);

}  // namespace groundglass
