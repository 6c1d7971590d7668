// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/overlay_shapes.h"

namespace groundglass {

void OverlayLine(const ImVec2& from, const ImVec2& to, ImU32 colour, float width) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddLine(from, to, kOverlayHalo, width + 2);
  list.AddLine(from, to, colour, width);
}

void OverlayRing(const ImVec2& at, float radius, ImU32 colour) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCircle(at, radius, kOverlayHalo, 16, 4);
  list.AddCircle(at, radius, colour, 16, 2);
}

void OverlayTriangle(const ImVec2& at, float size, ImU32 colour) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 top(at.x, at.y - size);
  const ImVec2 left(at.x - size, at.y + 0.7f * size);
  const ImVec2 right(at.x + size, at.y + 0.7f * size);
  list.AddTriangle(top, left, right, kOverlayHalo, 5);
  list.AddTriangle(top, left, right, colour, 2.5f);
}

void OverlayText(const ImVec2& at, ImU32 colour, const std::string& text) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const ImVec2& by : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1)}) {
    list.AddText(ImVec2(at.x + by.x, at.y + by.y), kOverlayHalo, text.c_str());
  }
  list.AddText(at, colour, text.c_str());
}

void OverlayLoop(const std::vector<ImVec2>& points, ImU32 colour, float width, bool is_dashed) {
  for (size_t i = 0; i < points.size(); i += is_dashed ? 2 : 1) {
    OverlayLine(points[i], points[(i + 1) % points.size()], colour, width);
  }
}

}  // namespace groundglass
