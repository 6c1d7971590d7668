// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_lines.h"
#include "scene/formats/xml_text.h"
#include "scene/text.h"

#include <array>
#include <cmath>

namespace groundglass {
namespace {

// To the tenth of a millimetre, which no pen draws.
std::string Metres(double value) { return FormatNumber(std::round(value * 1e4) / 1e4 + 0.0); }

// A code and its value on two lines, as DXF has it.
std::string Group(int code, const std::string& value) {
  return std::to_string(code) + "\n" + value + "\n";
}

std::string DxfLine(const std::string& layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return Group(0, "LINE") + Group(8, layer) + Group(10, Metres(a.x())) + Group(20, Metres(a.y())) +
         Group(30, "0") + Group(11, Metres(b.x())) + Group(21, Metres(b.y())) + Group(31, "0");
}

std::string DxfLayer(const std::string& name, int colour) {
  return Group(0, "LAYER") + Group(2, name) + Group(70, "0") + Group(62, std::to_string(colour)) +
         Group(6, "CONTINUOUS");
}

}  // namespace

std::string FormatSvg(const std::vector<DrawnLine>& lines, const LineSheet& sheet) {
  const double mm_per_m = 1000 / sheet.scale;
  const double top_m = sheet.v_start_m + sheet.height_m;
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
      Metres(sheet.width_m * mm_per_m) + "mm\" height=\"" + Metres(sheet.height_m * mm_per_m) +
      "mm\" viewBox=\"" + Metres(sheet.u_start_m) + " " + Metres(-top_m) + " " +
      Metres(sheet.width_m) + " " + Metres(sheet.height_m) + "\">\n<title>" +
      XmlEscaped(sheet.title) + ", 1:" + FormatNumber(sheet.scale) + "</title>\n";
  for (const LinePen& kind : kLinePens) {
    std::string path;
    for (const DrawnLine& line : lines) {
      if (line.kind != kind.kind) continue;
      path += "M" + Metres(line.start_m.x()) + " " + Metres(-line.start_m.y()) + "L" +
              Metres(line.end_m.x()) + " " + Metres(-line.end_m.y()) + "\n";
    }
    if (path.empty()) continue;
    text += std::string("<path id=\"") + kind.layer +
            "\" fill=\"none\" stroke=\"#000\" stroke-linecap=\"round\" stroke-width=\"" +
            FormatNumber(kind.width_mm / mm_per_m) + "\" d=\"" + path + "\"/>\n";
  }
  return text + "</svg>\n";
}

std::string FormatDxf(const std::vector<DrawnLine>& lines, const LineSheet& sheet) {
  const Eigen::Vector2d low(sheet.u_start_m, sheet.v_start_m);
  const Eigen::Vector2d high = low + Eigen::Vector2d(sheet.width_m, sheet.height_m);
  std::string text = Group(0, "SECTION") + Group(2, "HEADER") + Group(9, "$ACADVER") +
                     Group(1, "AC1009") + Group(9, "$INSUNITS") + Group(70, "6") +
                     Group(9, "$EXTMIN") + Group(10, Metres(low.x())) + Group(20, Metres(low.y())) +
                     Group(9, "$EXTMAX") + Group(10, Metres(high.x())) +
                     Group(20, Metres(high.y())) + Group(0, "ENDSEC");
  text += Group(0, "SECTION") + Group(2, "TABLES") + Group(0, "TABLE") + Group(2, "LTYPE") +
          Group(70, "1") + Group(0, "LTYPE") + Group(2, "CONTINUOUS") + Group(70, "0") +
          Group(3, "Solid line") + Group(72, "65") + Group(73, "0") + Group(40, "0") +
          Group(0, "ENDTAB") + Group(0, "TABLE") + Group(2, "LAYER") +
          Group(70, std::to_string(kLinePens.size() + 1));
  for (const LinePen& kind : kLinePens) text += DxfLayer(kind.layer, kind.dxf_colour);
  text += DxfLayer("FRAME", 9) + Group(0, "ENDTAB") + Group(0, "ENDSEC");
  text += Group(0, "SECTION") + Group(2, "ENTITIES");
  const std::array<Eigen::Vector2d, 4> corners = {
      low, Eigen::Vector2d(high.x(), low.y()), high, Eigen::Vector2d(low.x(), high.y())};
  for (size_t i = 0; i < 4; ++i) text += DxfLine("FRAME", corners[i], corners[(i + 1) % 4]);
  for (const LinePen& kind : kLinePens) {
    for (const DrawnLine& line : lines) {
      if (line.kind == kind.kind) text += DxfLine(kind.layer, line.start_m, line.end_m);
    }
  }
  return text + Group(0, "ENDSEC") + Group(0, "EOF");
}

}  // namespace groundglass
