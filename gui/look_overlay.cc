// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "gui/overlay_shapes.h"
#include "scene/symmetric_eigen.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Of a normal distribution over three numbers: the root of chi-square's 95 % with 3 degrees of
// freedom.
constexpr double kSigmasOf95Percent = 2.7955;

ImU32 AsImColour(const Srgb8Colour& colour) {
  return IM_COL32(colour[0], colour[1], colour[2], 255);
}

void DrawSwatch(ImDrawList& list, const ImVec2& from, const ImVec2& to, ImU32 colour) {
  list.AddRectFilled(from, to, colour);
  list.AddRect(from, to, IM_COL32(230, 230, 230, 255));
}

// The colours between two labels of a scale, in strips.
void DrawScale(const Legend& legend, int step, const ImVec2& from, const ImVec2& to) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  constexpr int kNumStrips = 12;
  const int num_steps = static_cast<int>(legend.entries.size()) - 2;
  for (int i = 0; i < kNumStrips; ++i) {
    const double share = (step + (i + 0.5) / kNumStrips) / num_steps;
    const float height = (to.y - from.y) / kNumStrips;
    const float top = from.y + height * static_cast<float>(i);
    list.AddRectFilled(
        ImVec2(from.x, top), ImVec2(to.x, top + height + 1), AsImColour(LengthScaleColour(share)));
  }
}

}  // namespace

// The three ellipses in which an ellipsoid's main planes cut it.
void App::DrawEllipsoid(const Eigen::Vector3d& middle_in_world,
                        const Eigen::Matrix3d& covariance,
                        unsigned colour,
                        bool is_dashed) {
  const Camera camera = PaneCamera();
  const SymmetricEigen axes = DecomposeSymmetric(covariance);
  const Eigen::Matrix3d half_axes =
      axes.vectors * (kSigmasOf95Percent * axes.values.cwiseMax(0).cwiseSqrt()).asDiagonal();
  constexpr int kNumPoints = 48;
  for (int plane = 0; plane < 3; ++plane) {
    std::vector<ImVec2> loop;
    for (int i = 0; i < kNumPoints; ++i) {
      const double angle = 2 * M_PI * i / kNumPoints;
      const auto seen = Project(camera,
                                middle_in_world + std::cos(angle) * half_axes.col(plane) +
                                    std::sin(angle) * half_axes.col((plane + 1) % 3));
      if (!seen) break;
      loop.push_back(
          {static_cast<float>(pane_.x + seen->x()), static_cast<float>(pane_.y + seen->y())});
    }
    if (loop.size() == kNumPoints) OverlayLoop(loop, colour, 1.2f, is_dashed);
  }
}

void App::DrawEllipsoids() {
  for (int i = 0; i < static_cast<int>(session_.photographs().size()); ++i) {
    const auto& written = WrittenCamera(i);
    const auto spread = written_spread_.find(session_.photographs()[i].name);
    if (written && spread != written_spread_.end()) {
      DrawEllipsoid(written->PositionInWorld(), spread->second, kOverlayGrey, true);
    }
    const std::optional<Camera> found = BelievedCamera(i);
    const std::optional<Eigen::Matrix3d> found_spread = FoundSpread(i);
    if (found && found_spread) {
      DrawEllipsoid(found->PositionInWorld(),
                    *found_spread,
                    i == photograph_ ? kOverlayYellow : kOverlaySkyBlue,
                    false);
    }
  }
}

void App::DrawLegend() {
  if (!shown_map_ || shown_map_->legend.entries.empty()) return;
  const Legend& legend = shown_map_->legend;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float line = ImGui::GetTextLineHeight() + 5;
  const float swatch = 1.4f * line;
  const int rows = static_cast<int>(legend.entries.size());
  float width = ImGui::CalcTextSize(legend.title.c_str()).x;
  for (const LegendEntry& entry : legend.entries) {
    width = std::max(width, swatch + 8 + ImGui::CalcTextSize(entry.label.c_str()).x);
  }
  const float height = line * static_cast<float>(rows + 1) + 12;
  const ImVec2 corner(static_cast<float>(pane_.x + 10),
                      static_cast<float>(pane_.y + pane_.height - 10) - height);
  list.AddRectFilled(
      corner, ImVec2(corner.x + width + 16, corner.y + height), IM_COL32(20, 20, 24, 235), 4);
  const ImU32 text = IM_COL32(238, 238, 238, 255);
  list.AddText(ImVec2(corner.x + 8, corner.y + 6), text, legend.title.c_str());
  // Of a scale without steps the colours run from one label's middle to the next one's.
  const auto middle = [&](int row) {
    return corner.y + 6 + line * (static_cast<float>(row) + 1.5f);
  };
  const float left = corner.x + 8;
  const float right = left + swatch;
  for (int i = 0; i < rows; ++i) {
    const LegendEntry& entry = legend.entries[i];
    const ImU32 colour = AsImColour(entry.colour);
    if (legend.is_continuous && i + 2 < rows) {
      DrawScale(legend, i, ImVec2(left, middle(i)), ImVec2(right, middle(i + 1)));
    } else if (!legend.is_continuous || i + 1 == rows) {
      DrawSwatch(list,
                 ImVec2(left, middle(i) - 0.4f * line),
                 ImVec2(right, middle(i) + 0.4f * line),
                 colour);
    }
    list.AddText(ImVec2(right + 8, middle(i) - 0.5f * line + 2), text, entry.label.c_str());
  }
}

}  // namespace groundglass
