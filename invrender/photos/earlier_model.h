// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/photo_options.h"
#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// The building as it was photographed, where the model shows what it has become: photographs speak
// only for surfaces that both have (Thorman 1988, chapter 6: a changed building).
class EarlierModel {
 public:
  // Both models must outlive this; they share frame and unit.
  EarlierModel(const PolygonModel& earlier,
               const PolygonModel& now,
               const EarlierModelOptions& options = {});

  // Of the earlier model.
  const Visibility& visibility() const { return visibility_; }

  // Faces of the present model of which no part was there, ascending.
  std::vector<int> FindNewFaces() const;

  // The present model's face, from 1, that each pixel's centre shows; 0 where what was photographed
  // is no longer there, or nothing was.
  Image16 MakeFaceMask(const Camera& camera) const;

  // Whether the earlier model has a surface at the point, and nothing of it stands before it.
  bool Shows(const Eigen::Vector3d& from_in_world, const Eigen::Vector3d& point_in_world) const;

 private:
  const PolygonModel& earlier_;
  const PolygonModel& now_;
  Visibility visibility_;
  Visibility visibility_now_;
  EarlierModelOptions options_;
  double tolerance_;
};

}  // namespace groundglass
