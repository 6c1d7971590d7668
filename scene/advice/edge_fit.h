// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/feature_edges.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <vector>

namespace groundglass {

// Whether a picture has edges where a camera sees the model's: coarse and quick, to tell a wrong
// reading of a photograph (upside down, mirrored, another view angle) from the right one. It finds
// no camera: `register` does.
class EdgeFit {
 public:
  // grey8: one channel, of any size.
  explicit EdgeFit(const Image8& grey8);

  // The model's visible edges are laid over the picture and moved about by as much as a
  // hand-written tag is off. How far the best place stands out from all of them, in their standard
  // deviations; 0 where too little of the model is in the frame. `camera`: of any size, of the
  // picture's shape. `nearness`: the best place is looked for within this share of the reach.
  double Score(const PolygonModel& model,
               const std::vector<ModelEdge>& edges,
               const Visibility& visibility,
               const Camera& camera,
               double nearness = 1) const;

 private:
  static constexpr int kDirections = 8;
  int width_ = 0;
  int height_ = 0;
  // For each direction of an edge's normal, how much of an edge across it a pixel shows, 0 to 1.
  std::vector<std::vector<float>> strength_;
};

// The picture turned by 180 degrees, or mirrored left to right.
Image8 UpsideDown(const Image8& picture);
Image8 MirroredPicture(const Image8& picture);

}  // namespace groundglass
