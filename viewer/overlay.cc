// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/overlay.h"

#include "scene/error.h"
#include "viewer/edge_drawing.h"
#include "viewer/line_drawing.h"

#include <algorithm>
#include <memory>
#include <string>

namespace groundglass {
namespace {

// A bright line on a dark casing reads on brick, foliage and sky alike.
constexpr Srgb8Colour kCasingColour = {16, 16, 20};
constexpr Srgb8Colour kMeasuredColour = {184, 184, 184};
constexpr Srgb8Colour kCorrectedColour = {0, 236, 255};

EdgeStyle MakeStyle(Srgb8Colour colour, double width_px, double silhouette_width_px) {
  EdgeStyle style;
  style.colour = colour;
  style.width_px = width_px;
  style.silhouette_width_px = silhouette_width_px;
  style.casing_colour = kCasingColour;
  style.casing_opacity = 0.55;
  style.casing_px = 0.7 * width_px;
  return style;
}

// One line of the legend for each camera drawn.
struct LegendRow {
  EdgeStyle style;
  const char* text;
};

void DrawLegend(Image8& picture, const std::vector<LegendRow>& rows) {
  if (rows.empty()) return;
  const double unit = LineUnit(picture);
  const double cap_height = 9 * unit;
  const double row_height = 19 * unit;
  const double sample_length = 34 * unit;
  const double pad = 10 * unit;
  double text_width = 0;
  for (const LegendRow& row : rows) {
    text_width = std::max(text_width, TextWidth(row.text, cap_height));
  }
  const double width = 3 * pad + sample_length + text_width;
  const double height = static_cast<double>(rows.size()) * row_height + pad;
  const double top = picture.height - pad - height;

  CoverageMask box(picture.width, picture.height, 1);
  for (int y = std::max(0, static_cast<int>(top)); y < picture.height - pad; ++y) {
    for (int x = static_cast<int>(pad); x < std::min<double>(picture.width, pad + width); ++x) {
      *box.At(x, y) = 1;
    }
  }
  LayOver(picture, box, kCasingColour, 0.62);
  double y = top + pad / 2 + row_height / 2;
  for (const LegendRow& row : rows) {
    CoverageMask sample(picture.width, picture.height, 1);
    AddLine(sample, {2 * pad, y}, {2 * pad + sample_length, y}, row.style.silhouette_width_px);
    LayOver(picture, sample, row.style.colour, 1);
    DrawText(picture,
             row.text,
             {3 * pad + sample_length, y + cap_height / 2},
             cap_height,
             row.style.colour);
    y += row_height;
  }
}

void CheckSize(const Image8& photograph, const Camera& camera, const std::string& which) {
  if (photograph.channels == 3 && photograph.width == camera.width_px &&
      photograph.height == camera.height_px) {
    return;
  }
  throw Error("overlay: the " + which + " camera is for an image of " +
              std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
              " x 3, the photograph has " + std::to_string(photograph.width) + " x " +
              std::to_string(photograph.height) + " x " + std::to_string(photograph.channels));
}

}  // namespace

Image8 DrawOverlay(const Image8& photograph_srgb8,
                   const PolygonModel& model,
                   const std::vector<ModelEdge>& edges,
                   const Visibility& visibility,
                   const OverlayCameras& cameras) {
  if (cameras.measured) CheckSize(photograph_srgb8, *cameras.measured, "measured");
  if (cameras.corrected) CheckSize(photograph_srgb8, *cameras.corrected, "corrected");
  Image8 picture = photograph_srgb8;
  const double unit = LineUnit(picture);
  std::vector<LegendRow> legend;
  const auto draw = [&](const Camera& camera, const LegendRow& row) {
    const auto spans = FindVisibleSpans(model, edges, visibility, camera, EdgeMargin(row.style));
    DrawEdges(picture, spans, camera, row.style);
    legend.push_back(row);
  };
  if (cameras.measured) {
    draw(*cameras.measured, {MakeStyle(kMeasuredColour, 1.1 * unit, 1.7 * unit), "measured"});
  }
  if (cameras.corrected) {
    draw(*cameras.corrected, {MakeStyle(kCorrectedColour, 1.4 * unit, 2.2 * unit), "corrected"});
  }
  DrawLegend(picture, legend);
  return picture;
}

Image8 DrawOverlay(const Image8& photograph_srgb8,
                   const PolygonModel& model,
                   const std::vector<ModelEdge>& edges,
                   const Visibility& visibility,
                   const Camera& measured,
                   const Camera* corrected) {
  return DrawOverlay(
      photograph_srgb8, model, edges, visibility, OverlayCameras{&measured, corrected});
}

std::function<std::vector<std::vector<Eigen::Vector2d>>(const Camera& camera)> MakeEdgeFinding(
    const PolygonModel& model) {
  const auto visibility = std::make_shared<const Visibility>(model);
  return [&model, visibility, edges = FindModelEdges(model)](const Camera& camera) {
    std::vector<std::vector<Eigen::Vector2d>> lines;
    for (const VisibleSpan& span : FindVisibleSpans(model, edges, *visibility, camera, 0)) {
      lines.push_back(ProjectSpan(camera, span.start_in_world, span.end_in_world));
    }
    return lines;
  };
}

}  // namespace groundglass
