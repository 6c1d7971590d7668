// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include <imgui/imgui.h>

#include <string>
#include <vector>

namespace groundglass {

// Okabe and Ito's colours; each thing has a shape of its own as well.
constexpr ImU32 kOverlayYellow = IM_COL32(240, 228, 66, 255);
constexpr ImU32 kOverlayVermilion = IM_COL32(213, 94, 0, 255);
constexpr ImU32 kOverlaySkyBlue = IM_COL32(86, 180, 233, 255);
constexpr ImU32 kOverlayGrey = IM_COL32(200, 200, 200, 255);
constexpr ImU32 kOverlayGreen = IM_COL32(0, 158, 115, 255);
constexpr ImU32 kOverlayPurple = IM_COL32(204, 121, 167, 255);
constexpr ImU32 kOverlayHalo = IM_COL32(10, 10, 14, 220);

// Shapes over the picture, each with a dark halo; positions in the window, px.
void OverlayLine(const ImVec2& from, const ImVec2& to, ImU32 colour, float width);
void OverlayRing(const ImVec2& at, float radius, ImU32 colour);
void OverlayTriangle(const ImVec2& at, float size, ImU32 colour);
void OverlayText(const ImVec2& at, ImU32 colour, const std::string& text);
// A closed line; dashed: every second part of it only.
void OverlayLoop(const std::vector<ImVec2>& points, ImU32 colour, float width, bool is_dashed);

}  // namespace groundglass
