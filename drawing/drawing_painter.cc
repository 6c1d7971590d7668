// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_painter.h"

#include <algorithm>

namespace groundglass {
namespace {

// OpenGL is asked for no more at once: with four samples a pixel this is 100 MB for 512 rows.
constexpr int kPartWidthPx = 4096;

}  // namespace

DrawingPainter::DrawingPainter(Renderer& renderer, const Drawing& drawing, const DrawingGrid& grid)
    : renderer_(renderer), grid_(grid), panels_(MakePanelViews(drawing, grid)) {}

template <typename T, typename Paint>
Raster<T> DrawingPainter::Assemble(int first_row,
                                   int num_rows,
                                   int channels,
                                   const Paint& paint) const {
  Raster<T> rows(grid_.width_px, num_rows, channels);
  for (const PanelView& panel : panels_) {
    for (int column = 0; column < panel.view.width_px; column += kPartWidthPx) {
      const int width_px = std::min(kPartWidthPx, panel.view.width_px - column);
      const Raster<T> part = paint(panel.view.Part(column, first_row, width_px, num_rows));
      for (int y = 0; y < num_rows; ++y) {
        std::copy_n(part.At(0, y),
                    static_cast<size_t>(width_px) * channels,
                    rows.At(panel.first_column + column, y));
      }
    }
  }
  return rows;
}

Image8 DrawingPainter::Colours(int first_row, int num_rows) const {
  return Assemble<uint8_t>(first_row, num_rows, 3, [&](const OrthographicView& view) {
    return renderer_.Render(view, RenderOptions());
  });
}

Image16 DrawingPainter::Faces(int first_row, int num_rows) const {
  return Assemble<uint16_t>(first_row, num_rows, 1, [&](const OrthographicView& view) {
    return renderer_.RenderLabels(view);
  });
}

}  // namespace groundglass
