// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "drawing/drawing.h"
#include "drawing/drawing_accuracy.h"
#include "drawing/drawing_sources.h"
#include "scene/textured_model.h"
#include "viewer/renderer.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

struct WriteDrawingOptions {
  double scale = 50;  // 1 : scale
  double dpi = 254;   // ten pixels a millimetre on paper
  // Which files are written: "tif", "pdf", "svg", "dxf", "layers". STEM.tif comes with STEM.tfw,
  // and every drawing with STEM.json; layers are STEM-photographs.tif, -sigma.tif and -height.tif,
  // and layers of the PDF.
  std::vector<std::string> kinds = {"tif"};
  bool has_title_block = true;  // of the PDF, with scale bar and north
  std::string title;            // of the PDF; empty: the drawing's name
  std::string note;

  double PixelInMetres() const { return scale * (25.4 / dpi) / 1000; }
  void Check() const;  // throws Error naming the first field out of range
};

struct WrittenDrawing {
  std::vector<std::filesystem::path> files;
  DrawingGrid grid;
  DrawingAccuracy accuracy;
  std::vector<std::string> warnings;  // besides those of its accuracy
};

// Writes a drawing of a textured model; the renderer holds the same. stem: the files' path but for
// what comes after it. sources: of colours, with provenance where layers are written.
WrittenDrawing WriteDrawing(const std::filesystem::path& stem,
                            Renderer& renderer,
                            const TexturedModel& textured,
                            const Drawing& drawing,
                            const DrawingSources& sources,
                            const WriteDrawingOptions& options);

}  // namespace groundglass
