// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "drawing/drawing_painter.h"
#include "drawing/drawing_sources.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// What is known of each pixel of a drawing besides its colour, row by row as the painter gives
// them. Painter, model and sources must outlive the object.
class DrawingLayers {
 public:
  DrawingLayers(const DrawingPainter& painter,
                const TexturedModel& textured,
                const DrawingSources& sources);

  // The photograph whose colour it is, from 1; kProvenanceNone, kProvenanceFilled.
  Image16 Photographs(int first_row, int num_rows) const;
  // One standard deviation of where it is, metres: the camera's on the wall and the model's
  // together; NaN where no photograph is.
  ImageF Sigmas(int first_row, int num_rows) const;
  // How far before the drawing's plane it is (behind: negative), metres; NaN where nothing is.
  ImageF Heights(int first_row, int num_rows) const;

 private:
  // Of one face in one panel, from the panel's image points.
  struct FaceMap {
    bool is_seen = false;
    Eigen::Vector3d depth_from_px = Eigen::Vector3d::Zero();  // times (x, y, 1), model's unit
    double nearest = 0;                                       // of its corners
    double farthest = 0;
    int page = -1;
    Eigen::Matrix<double, 2, 3> texel_from_px = Eigen::Matrix<double, 2, 3>::Zero();
  };
  FaceMap MakeFaceMap(const OrthographicView& view, int face) const;
  uint16_t PhotographAt(const FaceMap& map, const Eigen::Vector2d& image_px) const;
  template <typename T, typename Value>
  Raster<T> Fill(int first_row, int num_rows, T nothing, const Value& value) const;

  const DrawingPainter& painter_;
  const TexturedModel& textured_;
  const DrawingSources& sources_;
  std::vector<std::vector<FaceMap>> maps_;  // by the painter's panels, then by face
};

}  // namespace groundglass
