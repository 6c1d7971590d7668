// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "drawing/drawing.h"
#include "scene/image.h"
#include "scene/textured_model.h"
#include "viewer/renderer.h"

#include <string>
#include <vector>

namespace groundglass {

// Paints a drawing row by row from the top, as many rows at a time as the caller has memory for,
// whatever OpenGL's limit is: the picture is put together from parts.
class DrawingPainter {
 public:
  // The renderer must outlive the object. It is used by Colours and Faces.
  DrawingPainter(Renderer& renderer, const Drawing& drawing, const DrawingGrid& grid);

  const DrawingGrid& Grid() const { return grid_; }
  const std::vector<PanelView>& Panels() const { return panels_; }

  // Rows of the whole width. sRGB, 3 channels.
  Image8 Colours(int first_row, int num_rows) const;
  // The face of each pixel, from 1; 0 for none or a back.
  Image16 Faces(int first_row, int num_rows) const;

 private:
  template <typename T, typename Paint>
  Raster<T> Assemble(int first_row, int num_rows, int channels, const Paint& paint) const;

  Renderer& renderer_;
  DrawingGrid grid_;
  std::vector<PanelView> panels_;
};

}  // namespace groundglass
