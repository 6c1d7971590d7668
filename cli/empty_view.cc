// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/empty_view.h"

#include "scene/error.h"
#include "scene/length_unit.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <algorithm>

namespace groundglass {

std::string WhyNothingIsDrawn(const PolygonModel& model,
                              const Camera& camera,
                              const std::filesystem::path& view_file) {
  constexpr int kLongerSide = 128;
  const double scale =
      static_cast<double>(kLongerSide) / std::max(camera.width_px, camera.height_px);
  const Camera small = ResizedCamera(camera,
                                     std::max(1, static_cast<int>(camera.width_px * scale)),
                                     std::max(1, static_cast<int>(camera.height_px * scale)));
  const Visibility visibility(model);
  const Eigen::Vector3d position = small.PositionInWorld();
  for (int y = 0; y < small.height_px; ++y) {
    for (int x = 0; x < small.width_px; ++x) {
      if (visibility.FirstHit(position, UnprojectToWorld(small, {x + 0.5, y + 0.5}))) return "";
    }
  }
  return Error(view_file,
               "shows nothing of the model, or next to nothing; look at its numbers: in view files "
               "y counts to the south, and lengths are in the model's unit, " +
                   UnitName(model.unit))
      .what();
}

}  // namespace groundglass
