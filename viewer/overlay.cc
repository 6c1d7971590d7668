// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/overlay.h"

#include "scene/error.h"
#include "viewer/edge_drawing.h"
#include "viewer/line_drawing.h"

#include <algorithm>
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

void DrawLegend(Image8& picture, const EdgeStyle& measured, const EdgeStyle* corrected) {
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
    const EdgeStyle& style = row == 0 ? measured : *corrected;
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
  const EdgeStyle measured_style = MakeStyle(kMeasuredColour, 1.1 * unit, 1.7 * unit);
  const EdgeStyle corrected_style = MakeStyle(kCorrectedColour, 1.4 * unit, 2.2 * unit);
  const auto draw = [&](const Camera& camera, const EdgeStyle& style) {
    const auto spans = FindVisibleSpans(model, edges, visibility, camera, EdgeMargin(style));
    DrawEdges(picture, spans, camera, style);
  };
  draw(measured, measured_style);
  if (corrected) draw(*corrected, corrected_style);
  DrawLegend(picture, measured_style, corrected ? &corrected_style : nullptr);
  return picture;
}

}  // namespace groundglass
