// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "drawing/drawing_lines.h"
#include "drawing/drawing_painter.h"
#include "drawing/layer_pictures.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace groundglass {

struct PdfSheetOptions {
  double scale = 50;  // 1 : scale
  double dpi = 254;
  int jpeg_quality = 92;
  bool has_title_block = true;  // with scale bar and north
  std::string title;
  std::string note;                    // who drew it, when: as the person says
  std::vector<std::string> sentences;  // how accurate it is

  void Check() const;  // throws Error naming the first field out of range
};

// A drawing on a sheet as large as it needs, at true scale: layers Picture, Edges, those given
// (hidden at first) and Title block; readers' measuring tools count metres. metres_per_unit: of
// the drawing's lengths. Written beside its place and renamed into it. Returns the characters that
// its font cannot show.
std::set<std::string> WriteDrawingPdf(const std::filesystem::path& file,
                                      const Drawing& drawing,
                                      const DrawingPainter& painter,
                                      const std::vector<DrawnLine>& lines,
                                      const std::vector<LayerPicture>& layers,
                                      double metres_per_unit,
                                      const PdfSheetOptions& options);

}  // namespace groundglass
