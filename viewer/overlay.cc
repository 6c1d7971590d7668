// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/overlay.h"

#include "scene/error.h"
#include "viewer/line_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace groundglass {
namespace {

// A bright line on a dark casing reads on brick, foliage and sky alike.
struct LineStyle {
  Srgb8Colour colour;
  double width_px;
  double silhouette_width_px;
  double casing_px;  // on each side
};
constexpr Srgb8Colour kCasingColour = {16, 16, 20};
constexpr double kCasingOpacity = 0.55;
constexpr Srgb8Colour kMeasuredColour = {184, 184, 184};
constexpr Srgb8Colour kCorrectedColour = {0, 236, 255};

// The unit in which line widths are counted: 1 px for a picture of 1200 px.
double LineUnit(const Image8& picture) {
  return std::max(0.75, std::max(picture.width, picture.height) / 1200.0);
}

void DrawEdges(Image8& picture,
               const PolygonModel& model,
               const std::vector<ModelEdge>& edges,
               const Visibility& visibility,
               const Camera& camera,
               const LineStyle& style) {
  const double margin_px = 4 * style.silhouette_width_px;
  CoverageMask casing(picture.width, picture.height, 1);
  CoverageMask line(picture.width, picture.height, 1);
  for (const VisibleSpan& span : FindVisibleSpans(model, edges, visibility, camera, margin_px)) {
    const double width = span.is_silhouette ? style.silhouette_width_px : style.width_px;
    const auto points = ProjectSpan(camera, span.start_in_world, span.end_in_world);
    for (size_t i = 1; i < points.size(); ++i) {
      AddLine(casing, points[i - 1], points[i], width + 2 * style.casing_px);
      AddLine(line, points[i - 1], points[i], width);
    }
  }
  LayOver(picture, casing, kCasingColour, kCasingOpacity);
  LayOver(picture, line, style.colour, 1);
}

void DrawLegend(Image8& picture, const LineStyle& measured, const LineStyle* corrected) {
  const double unit = LineUnit(picture);
  const double cap_height = 9 * unit;
  const double row_height = 19 * unit;
  const double sample_length = 34 * unit;
  const double pad = 10 * unit;
  const int num_rows = corrected ? 2 : 1;
  const double width =
      3 * pad + sample_length + TextWidth(corrected ? "corrected" : "measured", cap_height);
  const double height = num_rows * row_height + pad;
  const double top = picture.height - pad - height;

  CoverageMask box(picture.width, picture.height, 1);
  for (int y = std::max(0, static_cast<int>(top)); y < picture.height - pad; ++y) {
    for (int x = static_cast<int>(pad); x < std::min<double>(picture.width, pad + width); ++x) {
      *box.At(x, y) = 1;
    }
  }
  LayOver(picture, box, kCasingColour, 0.62);
  for (int row = 0; row < num_rows; ++row) {
    const LineStyle& style = row == 0 ? measured : *corrected;
    const double y = top + pad / 2 + (row + 0.5) * row_height;
    CoverageMask sample(picture.width, picture.height, 1);
    AddLine(sample, {2 * pad, y}, {2 * pad + sample_length, y}, style.silhouette_width_px);
    LayOver(picture, sample, style.colour, 1);
    DrawText(picture,
             row == 0 ? "measured" : "corrected",
             {3 * pad + sample_length, y + cap_height / 2},
             cap_height,
             style.colour);
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

std::vector<Eigen::Vector2d> ProjectSpan(const Camera& camera,
                                         const Eigen::Vector3d& start_in_world,
                                         const Eigen::Vector3d& end_in_world) {
  const auto start_px = Project(camera, start_in_world);
  const auto end_px = Project(camera, end_in_world);
  if (!start_px || !end_px) return {};
  const bool bent = camera.k1 != 0 || camera.k2 != 0;
  const int num_pieces =
      bent ? std::clamp(static_cast<int>((*end_px - *start_px).norm() / 8), 1, 400) : 1;
  std::vector<Eigen::Vector2d> points = {*start_px};
  for (int i = 1; i < num_pieces; ++i) {
    const double t = static_cast<double>(i) / num_pieces;
    const auto point_px = Project(camera, (1 - t) * start_in_world + t * end_in_world);
    if (point_px) points.push_back(*point_px);
  }
  points.push_back(*end_px);
  return points;
}

Image8 DrawOverlay(const Image8& photograph_srgb8,
                   const PolygonModel& model,
                   const std::vector<ModelEdge>& edges,
                   const Visibility& visibility,
                   const Camera& measured,
                   const Camera* corrected) {
  CheckSize(photograph_srgb8, measured, "measured");
  if (corrected) CheckSize(photograph_srgb8, *corrected, "corrected");
  Image8 picture = photograph_srgb8;
  const double unit = LineUnit(picture);
  const LineStyle measured_style = {kMeasuredColour, 1.1 * unit, 1.7 * unit, 0.8 * unit};
  const LineStyle corrected_style = {kCorrectedColour, 1.4 * unit, 2.2 * unit, 1.0 * unit};
  DrawEdges(picture, model, edges, visibility, measured, measured_style);
  if (corrected) DrawEdges(picture, model, edges, visibility, *corrected, corrected_style);
  DrawLegend(picture, measured_style, corrected ? &corrected_style : nullptr);
  return picture;
}

}  // namespace groundglass
