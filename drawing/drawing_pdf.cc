// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_pdf.h"

#include "drawing/pdf_writer.h"
#include "scene/check_option.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace groundglass {
namespace {

constexpr double kBorderMm = 10;       // of the sheet
constexpr double kLeastWidthMm = 150;  // that the title block needs
constexpr double kTextMm = 2.6;
constexpr double kLineMm = 3.6;
// JPEG takes no more than 65,535 px, and readers no more than some thousand without trouble.
constexpr int kPieceRows = 1024;
constexpr int kPieceColumns = 8192;

// Words in lines that fit: Helvetica's letters are half as wide as high, on the average.
std::vector<std::string> Wrapped(const std::string& text, double width_mm) {
  const auto most = static_cast<size_t>(std::max(20.0, width_mm / (0.5 * kTextMm)));
  std::vector<std::string> lines;
  std::string line;
  size_t start = 0;
  while (start < text.size()) {
    const size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (!line.empty() && line.size() + 1 + word.size() > most) {
      lines.push_back(line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    start = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

// The length of a scale bar, metres: 1, 2 or 5 times a power of ten, up to 60 mm on paper.
double ScaleBarLength(double scale) {
  const double most_m = 0.06 * scale;
  const double power = std::pow(10, std::floor(std::log10(most_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= most_m) return step * power;
  }
  return power;
}

void DrawScaleBar(PdfPage& page, const Eigen::Vector2d& at_mm, double scale) {
  const double length_m = ScaleBarLength(scale);
  const double length_mm = 1000 * length_m / scale;
  page.SetPen(0.2, 0);
  for (int part = 0; part < 5; ++part) {
    const Eigen::Vector2d low = at_mm + Eigen::Vector2d(part * length_mm / 5, 0);
    const double tone = part % 2 == 0 ? 0 : 1;
    page.SetFill(tone, tone, tone);
    page.FillRectangle(low, {length_mm / 5, 1.6});
  }
  for (const double y : {0.0, 1.6}) {
    page.DrawLine(at_mm + Eigen::Vector2d(0, y), at_mm + Eigen::Vector2d(length_mm, y));
  }
  page.DrawLine(at_mm, at_mm + Eigen::Vector2d(0, 1.6));
  page.DrawLine(at_mm + Eigen::Vector2d(length_mm, 0), at_mm + Eigen::Vector2d(length_mm, 1.6));
  page.SetFill(0, 0, 0);
  page.DrawText(at_mm + Eigen::Vector2d(-0.7, 2.6), kTextMm, "0");
  page.DrawText(
      at_mm + Eigen::Vector2d(length_mm - 2, 2.6), kTextMm, FormatNumber(length_m) + " m");
}

// A plan of the wall, level, as the viewer below it sees it, and where north is from there.
void DrawNorth(PdfPage& page, const Eigen::Vector2d& middle_mm, const DrawingPlane& plane) {
  constexpr double kRadiusMm = 7;
  const bool is_plan = std::abs(plane.TowardsViewer().z()) > 0.99;
  // The viewer's way ahead is up on paper.
  const Eigen::Vector3d ahead =
      is_plan ? plane.up_in_world : Eigen::Vector3d(-plane.TowardsViewer());
  const Eigen::Vector2d north(plane.right_in_world.y(), ahead.y());
  const Eigen::Vector2d direction = north.normalized();
  const Eigen::Vector2d across(-direction.y(), direction.x());
  page.SetPen(0.2, 0);
  page.SetFill(0, 0, 0);
  page.DrawLine(middle_mm - kRadiusMm * direction, middle_mm + kRadiusMm * direction);
  page.FillTriangle(middle_mm + kRadiusMm * direction,
                    middle_mm + (kRadiusMm - 4) * direction + 1.2 * across,
                    middle_mm + (kRadiusMm - 4) * direction - 1.2 * across);
  page.DrawText(middle_mm + (kRadiusMm + 2.2) * direction - Eigen::Vector2d(1, 1), 3.2, "N");
  if (is_plan) return;
  page.SetPen(0.8, 0);
  page.DrawLine(middle_mm - Eigen::Vector2d(5, 0), middle_mm + Eigen::Vector2d(5, 0));
}

std::string Facing(const Drawing& drawing) {
  const DrawingPlane& plane = drawing.panels.front().plane;
  if (drawing.panels.size() > 1) {
    return std::to_string(drawing.panels.size()) + " fronts laid side by side";
  }
  if (std::abs(plane.TowardsViewer().z()) > 0.99) return "plan";
  const long bearing_deg = std::lround(FacingDeg(plane)) % 360;
  return "faces " + CompassWord(static_cast<double>(bearing_deg)) + ", " +
         std::to_string(bearing_deg) + "\u00b0 from north";
}

// Where things are on the sheet, mm.
struct Layout {
  Eigen::Vector2d picture_mm;  // its size
  double text_width_mm = 0;
  double block_mm = 0;  // height of the title block
  std::vector<std::string> lines;
  double width_mm = 0;
  double height_mm = 0;
  Eigen::Vector2d PictureLow() const { return {kBorderMm, kBorderMm + block_mm}; }
};

size_t LegendRows(const std::vector<LayerPicture>& layers) {
  size_t rows = 0;
  for (const LayerPicture& layer : layers) rows = std::max(rows, layer.legend.size());
  return rows > 0 ? (rows + 5) / 6 : 0;
}

Layout MakeLayout(const DrawingGrid& grid,
                  const std::vector<LayerPicture>& layers,
                  const PdfSheetOptions& options) {
  Layout layout;
  layout.picture_mm = Eigen::Vector2d(grid.width_px, grid.height_px) * 25.4 / options.dpi;
  const double least_mm = options.has_title_block ? kLeastWidthMm : 0;
  const double inside_mm = std::max(layout.picture_mm.x(), least_mm);
  if (options.has_title_block) {
    layout.text_width_mm = inside_mm;
    for (const std::string& sentence : options.sentences) {
      for (const std::string& line : Wrapped(sentence, inside_mm)) layout.lines.push_back(line);
    }
    layout.block_mm =
        32 + kLineMm * (static_cast<double>(layout.lines.size() + LegendRows(layers)) + 1);
  }
  layout.width_mm = inside_mm + 2 * kBorderMm;
  layout.height_mm = layout.picture_mm.y() + layout.block_mm + 2 * kBorderMm;
  return layout;
}

void DrawPieces(PdfPage& page,
                const DrawingPainter& painter,
                const Layout& layout,
                const PdfSheetOptions& options) {
  const double mm = 25.4 / options.dpi;
  const DrawingGrid& grid = painter.Grid();
  const double top_mm = layout.PictureLow().y() + layout.picture_mm.y();
  for (int row = 0; row < grid.height_px; row += kPieceRows) {
    // Pieces overlap by a pixel, since readers leave hairlines between what only touches.
    const Image8 band = painter.Colours(row, std::min(kPieceRows + 1, grid.height_px - row));
    for (int column = 0; column < grid.width_px; column += kPieceColumns) {
      const int width = std::min(kPieceColumns + 1, grid.width_px - column);
      Image8 piece(width, band.height, 3);
      for (int y = 0; y < band.height; ++y) {
        std::copy_n(band.At(column, y), 3 * static_cast<size_t>(width), piece.At(0, y));
      }
      page.DrawPicture(piece,
                       {layout.PictureLow().x() + column * mm, top_mm - (row + band.height) * mm},
                       Eigen::Vector2d(width, band.height) * mm,
                       options.jpeg_quality);
    }
  }
}

void DrawLines(PdfPage& page,
               const std::vector<DrawnLine>& lines,
               const Eigen::Vector2d& sheet_low_m,
               const Layout& layout,
               double scale) {
  const double mm_per_m = 1000 / scale;
  for (const LinePen& pen : kLinePens) {
    page.SetPen(pen.width_mm, 0);
    for (const DrawnLine& line : lines) {
      if (line.kind != pen.kind) continue;
      page.DrawLine(layout.PictureLow() + (line.start_m - sheet_low_m) * mm_per_m,
                    layout.PictureLow() + (line.end_m - sheet_low_m) * mm_per_m);
    }
  }
}

void DrawLegend(PdfPage& page, const LayerPicture& layer, const Layout& layout) {
  const double column_mm = layout.text_width_mm / 6;
  for (size_t i = 0; i < layer.legend.size(); ++i) {
    const LayerPicture::Entry& entry = layer.legend[i];
    const size_t column = i % 6;
    const size_t row = i / 6;
    const Eigen::Vector2d at(kBorderMm + column_mm * static_cast<double>(column),
                             kBorderMm + kLineMm * static_cast<double>(row));
    page.SetFill(entry.colour[0] / 255.0, entry.colour[1] / 255.0, entry.colour[2] / 255.0);
    page.FillRectangle(at, {3, 2});
    page.SetFill(0, 0, 0);
    page.DrawText(at + Eigen::Vector2d(4, 0), kTextMm, entry.meaning);
  }
}

void DrawTitleBlock(PdfPage& page,
                    const Drawing& drawing,
                    const Layout& layout,
                    const PdfSheetOptions& options) {
  const double left = kBorderMm;
  const double top = layout.PictureLow().y();
  page.SetFill(0, 0, 0);
  page.DrawText({left, top - 9}, 5, options.title);
  page.DrawText(
      {left, top - 14.5}, 3.4, "1:" + FormatNumber(options.scale) + "   " + Facing(drawing));
  if (!options.note.empty()) page.DrawText({left, top - 19}, kTextMm, options.note);
  DrawScaleBar(page, {left + 0.7, top - 27}, options.scale);
  DrawNorth(page, {layout.width_mm - kBorderMm - 12, top - 14}, drawing.panels.front().plane);
  double y = top - 33;
  page.SetFill(0, 0, 0);
  for (const std::string& line : layout.lines) {
    page.DrawText({left, y}, kTextMm, line);
    y -= kLineMm;
  }
}

}  // namespace

void PdfSheetOptions::Check() const {
  CheckAbove(scale, 0, "PDF options: scale");
  CheckFromTo(dpi, 10, 2400, "PDF options: dpi");
  CheckFromTo(jpeg_quality, 1, 100, "PDF options: jpeg_quality");
}

std::set<std::string> WriteDrawingPdf(const std::filesystem::path& file,
                                      const Drawing& drawing,
                                      const DrawingPainter& painter,
                                      const std::vector<DrawnLine>& lines,
                                      const std::vector<LayerPicture>& layers,
                                      double metres_per_unit,
                                      const PdfSheetOptions& options) {
  options.Check();
  const Layout layout = MakeLayout(painter.Grid(), layers, options);
  std::set<std::string> unshown;
  StreamFileAtomically(file, [&](const ByteSink& append) {
    PdfPage page(append, layout.width_mm, layout.height_mm);
    page.SetMeasure(layout.PictureLow(), layout.picture_mm, options.scale);
    page.BeginLayer(page.AddLayer("Picture", true));
    DrawPieces(page, painter, layout, options);
    page.EndLayer();
    for (const LayerPicture& layer : layers) {
      page.BeginLayer(page.AddLayer(layer.name, false));
      const Eigen::Vector2d size_mm = Eigen::Vector2d(layer.srgb8.width, layer.srgb8.height) *
                                      (1000 * metres_per_unit * layer.pixel_size / options.scale);
      const double top_mm = layout.PictureLow().y() + layout.picture_mm.y();
      page.DrawPicture(layer.srgb8, {layout.PictureLow().x(), top_mm - size_mm.y()}, size_mm, 97);
      if (options.has_title_block) DrawLegend(page, layer, layout);
      page.EndLayer();
    }
    page.BeginLayer(page.AddLayer("Edges", true));
    // The picture's lower border, which a part of a pixel may have moved.
    const double bottom_m =
        drawing.v_end * metres_per_unit - layout.picture_mm.y() * options.scale / 1000;
    DrawLines(page, lines, {drawing.UStart() * metres_per_unit, bottom_m}, layout, options.scale);
    page.EndLayer();
    if (options.has_title_block) {
      page.BeginLayer(page.AddLayer("Title block", true));
      DrawTitleBlock(page, drawing, layout, options);
      page.EndLayer();
    }
    page.Finish(options.title);
    unshown = page.UnshownCharacters();
  });
  return unshown;
}

}  // namespace groundglass
