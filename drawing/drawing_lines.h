// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "drawing/drawing.h"

#include <Eigen/Dense>

#include <array>
#include <string>
#include <vector>

namespace groundglass {

// A line of a drawing: on the sheet (u to the right, v up), in metres.
struct DrawnLine {
  enum class Kind {
    kEdge,     // two faces meet
    kOutline,  // something farther away lies beyond it
    kCut,      // where the plane of a section cuts a face
  };
  Eigen::Vector2d start_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_m = Eigen::Vector2d::Zero();
  Kind kind = Kind::kEdge;
};

// How each kind is drawn, in the order in which they lie over one another.
struct LinePen {
  DrawnLine::Kind kind;
  const char* layer;  // of DXF, and the group's name in SVG
  int dxf_colour;     // AutoCAD's index
  double width_mm;    // on paper
};
inline constexpr std::array<LinePen, 3> kLinePens = {
    {{DrawnLine::Kind::kEdge, "EDGES", 8, 0.13},
     {DrawnLine::Kind::kOutline, "OUTLINE", 7, 0.25},
     {DrawnLine::Kind::kCut, "CUT", 1, 0.5}}};

// The model's edges, hidden lines removed, and the cut faces of a section; clipped to the sheet.
// Ends are found to a tenth of pixel_size (model's unit).
std::vector<DrawnLine> FindDrawnLines(const PolygonModel& model,
                                      const Drawing& drawing,
                                      double pixel_size);

// What the lines over a picture are written into: the size of the drawing, and 1 : scale.
struct LineSheet {
  std::string title;
  double u_start_m = 0;
  double v_start_m = 0;
  double width_m = 0;
  double height_m = 0;
  double scale = 50;
};
// SVG at true scale: as many millimetres as it is to be printed, and user units of metres with the
// sheet's own u and -v, one group for each kind of line.
std::string FormatSvg(const std::vector<DrawnLine>& lines, const LineSheet& sheet);
// DXF as AutoCAD R12 reads it, in metres and of true size: u and v are x and y; layers EDGES,
// OUTLINE, CUT and FRAME (the picture's border, to fit the picture into).
std::string FormatDxf(const std::vector<DrawnLine>& lines, const LineSheet& sheet);

}  // namespace groundglass
