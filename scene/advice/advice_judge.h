// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/advice/advice_suitability.h"
#include "scene/advice/edge_fit.h"

#include <optional>
#include <vector>

namespace groundglass {

// Tells by the pictures' edges which of two readings of a scene is the right one. Some photographs
// are looked at, and decoded when they are first asked for.
class PictureJudge {
 public:
  explicit PictureJudge(const Scene& scene) : photographs_(SomePhotographs(scene)) {}

  // How the edges of a model fit each picture (EdgeFit::Score); 0 where that cannot be told.
  // `nearness`: how far from its tag's place, as a share of the usual reach.
  std::vector<double> Fit(const PolygonModel& model,
                          const Retag& retag = {},
                          double nearness = 1) const;
  // Of all pictures of which it is known; 0 of none.
  static double Mean(const std::vector<double>& fits);
  // Nearly all pictures are fitted better than by the other, and clearly so.
  static bool IsClearlyBetter(const std::vector<double>& fits, const std::vector<double>& others);

 private:
  std::vector<const Photograph*> photographs_;
  mutable std::vector<std::optional<EdgeFit>> edges_;
};

// The model read otherwise, its faces with their fronts where the reading has them.
PolygonModel ReadOtherwise(PolygonModel model, const OtherReading& reading);

}  // namespace groundglass
