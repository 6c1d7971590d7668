// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/feature_edges.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <optional>
#include <vector>

namespace groundglass {

// The face under a place of the picture, and where it is met.
struct FacePick {
  int face = -1;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
};
std::optional<FacePick> PickFace(const Visibility& visibility,
                                 const Camera& camera,
                                 const Eigen::Vector2d& image_px);

// A point of the model that the camera sees.
struct VisibleCorner {
  int point = -1;  // of the model
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
};
// Those inside the frame, from left to right, so that keys can step through them.
std::vector<VisibleCorner> FindVisibleCorners(const PolygonModel& model,
                                              const Visibility& visibility,
                                              const Camera& camera);
// The nearest of them within reach.
std::optional<VisibleCorner> PickCorner(const std::vector<VisibleCorner>& corners,
                                        const Eigen::Vector2d& image_px,
                                        double reach_px);

// The span (FindVisibleSpans) that passes nearest within reach, by its place; straight between its
// ends.
std::optional<int> PickSpan(const std::vector<VisibleSpan>& spans,
                            const Camera& camera,
                            const Eigen::Vector2d& image_px,
                            double reach_px);

}  // namespace groundglass
