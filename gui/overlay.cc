// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "gui/overlay_shapes.h"

#include <imgui/imgui.h>

#include <cmath>

namespace groundglass {
namespace {

constexpr int kMostStationsInFull = 100;  // while something moves

ImVec2 OnScreen(const Pane& pane, const Eigen::Vector2d& pane_px) {
  return {static_cast<float>(pane.x + pane_px.x()), static_cast<float>(pane.y + pane_px.y())};
}

std::string Px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

}  // namespace

void App::DrawOverlayLines() {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(ImVec2(static_cast<float>(pane_.x), static_cast<float>(pane_.y)),
                    ImVec2(static_cast<float>(pane_.x + pane_.width),
                           static_cast<float>(pane_.y + pane_.height)));
  if (!IsInside() && shows_ellipsoids_) DrawEllipsoids();
  if (!IsInside() && shows_stations_) DrawStations();
  DrawFlight();
  if (!IsInside() || model_share_ > 0) DrawLegend();
  if (CanTag()) DrawPins();
  if (CanTag()) DrawLoupe();
  if (CanMask()) DrawMaskTools();
  if (!CanTag() && !CanMask()) DrawPlaces();
  list.PopClipRect();
}

void App::DrawStations() {
  const Camera camera = PaneCamera();
  const double size = 0.06 * ComputeBounds(session_.model()).Diagonal();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const int num_stations = static_cast<int>(session_.photographs().size());
  // Pictures and names of hundreds are most of a frame's time: while something moves, lines will
  // do.
  const bool is_brief = num_stations > kMostStationsInFull && governor_.IsMoving(NowMs());
  for (int i = 0; i < num_stations; ++i) {
    const std::optional<Camera>& written = WrittenCamera(i);
    const std::optional<Camera> found = BelievedCamera(i);
    if (!found) continue;
    const Eigen::Vector3d apex = found->PositionInWorld();
    const auto apex_px = Project(camera, apex);
    if (!apex_px) continue;
    const ImU32 colour = i == photograph_ ? kOverlayYellow : kOverlaySkyBlue;
    std::array<ImVec2, 4> corners;
    bool is_seen = true;
    for (int c = 0; c < 4; ++c) {
      const Eigen::Vector2d at((c == 1 || c == 2) ? found->width_px : 0,
                               c >= 2 ? found->height_px : 0);
      const auto corner = Project(camera, apex + size * UnprojectToWorld(*found, at));
      if (!corner) {
        is_seen = false;
        break;
      }
      corners[c] = OnScreen(pane_, *corner);
    }
    const ImVec2 from = OnScreen(pane_, *apex_px);
    if (is_seen) {
      const auto thumbnail = thumbnails_.find(i);
      if (thumbnail != thumbnails_.end() && !is_brief) {
        list.AddImageQuad(thumbnail->second.get(), corners[0], corners[1], corners[2], corners[3]);
      }
      for (int c = 0; c < 4; ++c) {
        OverlayLine(from, corners[c], colour, 1);
        OverlayLine(corners[c], corners[(c + 1) % 4], colour, 1.5f);
      }
    }
    if (written) {
      if (const auto was = Project(camera, written->PositionInWorld())) {
        const ImVec2 at = OnScreen(pane_, *was);
        OverlayLine(at, from, kOverlayGrey, 1);
        list.AddRect(ImVec2(at.x - 3, at.y - 3), ImVec2(at.x + 3, at.y + 3), kOverlayGrey);
      }
    }
    if (is_brief && i != photograph_) continue;
    // Beside the picture, which would hide it.
    ImVec2 right = from;
    for (const ImVec2& corner : corners) {
      if (is_seen && corner.x > right.x) right = corner;
    }
    OverlayText(ImVec2(right.x + 5, right.y - 8), colour, session_.photographs()[i].name);
  }
}

void App::DrawPins() {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto& solution = session_.Solution(photograph_);
  const Pins& pins = session_.work(photograph_).pins;
  for (const VisibleCorner& corner : Corners()) {
    const ImVec2 at = OnScreen(pane_, corner.image_px);
    const bool is_armed = armed_point_ && *armed_point_ == corner.point;
    list.AddRectFilled(ImVec2(at.x - 2, at.y - 2), ImVec2(at.x + 2, at.y + 2), kOverlayHalo);
    list.AddRectFilled(ImVec2(at.x - 1, at.y - 1), ImVec2(at.x + 1, at.y + 1), kOverlaySkyBlue);
    if (is_armed) OverlayRing(at, 9, kOverlaySkyBlue);
  }
  for (size_t i = 0; i < pins.points.size(); ++i) {
    const PointPin& pin = pins.points[i];
    const ImVec2 at = OnScreen(pane_, place_.InPicture(pin.image_px));
    const bool is_bad = solution && solution->points[i].is_bad;
    const ImU32 colour = is_bad                    ? kOverlayVermilion
                         : pin.use == PinUse::kOff ? kOverlayGrey
                                                   : kOverlayYellow;
    if (is_bad) {
      OverlayTriangle(at, 9, colour);
    } else {
      OverlayRing(at, pin_ == static_cast<int>(i) ? 9.0f : 6.0f, colour);
    }
    if (!solution || !solution->points[i].seen_px) continue;
    // Ten times as long as it is, so that it is seen.
    const Eigen::Vector2d by = 10 * place_.scale * solution->points[i].residual_px;
    OverlayLine(at,
                ImVec2(at.x + static_cast<float>(by.x()), at.y + static_cast<float>(by.y())),
                colour,
                1);
    OverlayText(ImVec2(at.x + 11, at.y - 8),
                colour,
                std::to_string(i + 1) + "  " + Px(solution->points[i].size_px));
  }
  for (size_t i = 0; i < pins.lines.size(); ++i) {
    const ImVec2 first = OnScreen(pane_, place_.InPicture(pins.lines[i].first_px));
    const ImVec2 second = OnScreen(pane_, place_.InPicture(pins.lines[i].second_px));
    const bool is_bad = solution && solution->lines[i].is_bad;
    const ImU32 colour = is_bad                              ? kOverlayVermilion
                         : pins.lines[i].use == PinUse::kOff ? kOverlayGrey
                                                             : kOverlayYellow;
    OverlayLine(first, second, colour, 2);
    OverlayRing(first, 4, colour);
    OverlayRing(second, 4, colour);
    if (solution) {
      OverlayText(ImVec2((first.x + second.x) / 2 + 8, (first.y + second.y) / 2 - 8),
                  colour,
                  Px(solution->lines[i].size_px));
    }
  }
}

// What is under the cursor, or the pin that is nudged, enlarged; in the corner that is away from
// it.
void App::DrawLoupe() {
  const Pins& pins = session_.work(photograph_).pins;
  const bool is_dragged =
      has_moved_ &&
      (gesture_ == Gesture::kPin || gesture_ == Gesture::kNewPin || gesture_ == Gesture::kLine);
  const bool is_point = pin_ && *pin_ < static_cast<int>(pins.points.size());
  if (!is_dragged && !is_point && !shows_loupe_) return;
  const auto picture = cache_.Find(photograph_);
  if (!picture) return;
  const Eigen::Vector2d at_px =
      is_point ? pins.points[*pin_].image_px : place_.InPhotograph(mouse_px_);
  constexpr int kLoupePx = 240;
  constexpr int kLoupeRadiusPx = 15;
  loupe_ = window_.MakeTexture(CropAround(*picture, at_px, kLoupeRadiusPx, kLoupePx));
  const bool is_left = place_.InPicture(at_px).x() > pane_.width / 2.0;
  const float x =
      static_cast<float>(is_left ? pane_.x + 10 : pane_.x + pane_.width - kLoupePx - 10);
  const float y = static_cast<float>(pane_.y + 10);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddImage(loupe_.get(), ImVec2(x, y), ImVec2(x + kLoupePx, y + kLoupePx));
  list.AddRect(ImVec2(x, y), ImVec2(x + kLoupePx, y + kLoupePx), kOverlayYellow);
}

void App::DrawPlaces() {
  const Camera camera = PaneCamera();
  std::vector<ImVec2> seen;
  for (size_t i = 0; i < places_.size(); ++i) {
    const auto at = Project(camera, places_[i].point_in_world);
    if (!at) continue;
    seen.push_back(OnScreen(pane_, *at));
    OverlayRing(seen.back(), 7, kOverlayGreen);
    OverlayText(
        ImVec2(seen.back().x + 10, seen.back().y - 8), kOverlayGreen, std::to_string(i + 1));
  }
  for (size_t i = 0; i + 1 < seen.size(); ++i) OverlayLine(seen[i], seen[i + 1], kOverlayGreen, 2);
  if (seen.size() == 3) OverlayLine(seen[2], seen[0], kOverlayGreen, 2);
}

}  // namespace groundglass
