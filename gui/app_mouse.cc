// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace groundglass {
namespace {

constexpr double kClickPx = 4;  // a press that moves less is a click

}  // namespace

// Whether something stands before the picture and the plan. The panels are beside them, so what the
// mouse is over follows from where it is, from the first press on.
bool App::IsCovered() const {
  return shows_help_ || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId);
}

void App::HandleMouseButton(const SDL_MouseButtonEvent& button) {
  const Eigen::Vector2d at = pane_.Inside(button.x, button.y);
  mouse_px_ = at;
  if (button.type == SDL_MOUSEBUTTONUP) {
    if (gesture_ == Gesture::kRough) {
      rough_end_ = OnPlan(button.x, button.y);
      ReleaseOnPlan();
      gesture_ = Gesture::kNone;
      return;
    }
    if (CanTag() && button.button == SDL_BUTTON_LEFT) ReleaseInTag(at);
    if (CanMask()) ReleaseInMask();
    const bool is_click = !has_moved_ && gesture_ == Gesture::kOrbit;
    if (is_click && mode_ == WindowMode::kLook) {
      picked_ = PickFace(visibility_, PaneCamera(), at);
    }
    gesture_ = Gesture::kNone;
    return;
  }
  if (IsCovered() || !pane_.Holds(button.x, button.y)) depth_before_press_.reset();
  if (IsCovered()) return;
  if (plan_.Holds(button.x, button.y)) PressOnPlan(button.x, button.y);
  if (!pane_.Holds(button.x, button.y)) return;
  has_moved_ = false;
  pressed_px_ = at;
  const bool shift = (SDL_GetModState() & KMOD_SHIFT) != 0;
  if (mode_ == WindowMode::kAsk && button.button == SDL_BUTTON_LEFT) {
    AskAt(at, shift);
    return;
  }
  if (CanTag() && button.button == SDL_BUTTON_LEFT) {
    PressInTag(at);
    return;
  }
  if (CanMask()) {
    PressInMask(at, button.button, button.clicks == 2, shift);
    return;
  }
  if (IsInside()) {
    gesture_ = Gesture::kMovePhotograph;
    return;
  }
  about_in_world_ = PointUnder(at);
  depth_ = (about_in_world_ - eye_.position_in_world).dot(eye_.Forward());
  const bool pans = button.button == SDL_BUTTON_MIDDLE || shift;
  gesture_ = button.button == SDL_BUTTON_RIGHT || is_walking_ ? Gesture::kLook
             : pans                                           ? Gesture::kPan
                                                              : Gesture::kOrbit;
  if (button.clicks == 2 && button.button == SDL_BUTTON_LEFT) {
    eyes_before_.push_back(eye_);
    MoveEye(Dolly(eye_, about_in_world_, 3));
  }
}

void App::HandleMouseMotion(const SDL_MouseMotionEvent& motion) {
  const Eigen::Vector2d at = pane_.Inside(motion.x, motion.y);
  const Eigen::Vector2d by = at - mouse_px_;
  mouse_px_ = at;
  mouse_x_ = motion.x;
  mouse_y_ = motion.y;
  if ((at - pressed_px_).norm() > kClickPx) has_moved_ = true;
  if (wipes_ && IsInside()) governor_.Moved(NowMs());
  switch (gesture_) {
    case Gesture::kOrbit:
      MoveEye(Orbit(eye_, about_in_world_, by.x(), by.y()));
      break;
    case Gesture::kPan:
      MoveEye(Pan(eye_, depth_, by.x(), by.y(), pane_.width));
      break;
    case Gesture::kLook:
      MoveEye(LookAround(eye_, by.x(), by.y()));
      break;
    case Gesture::kRough:
      rough_end_ = OnPlan(motion.x, motion.y);
      break;
    case Gesture::kMovePhotograph:
      place_.origin_px += by;
      break;
    case Gesture::kPin:
    case Gesture::kNewPin:
    case Gesture::kLine:
      governor_.Moved(NowMs());
      DragInTag(at, by, (SDL_GetModState() & KMOD_SHIFT) != 0);
      break;
    case Gesture::kPaint:
    case Gesture::kLasso:
      DragInMask(at);
      break;
    default:
      break;
  }
}

void App::HandleWheel(const SDL_MouseWheelEvent& wheel) {
  const bool is_in_pane = mouse_px_.x() >= 0 && mouse_px_.y() >= 0 && mouse_px_.x() < pane_.width &&
                          mouse_px_.y() < pane_.height;
  if (IsCovered() || !is_in_pane) return;
  const bool shift = (SDL_GetModState() & KMOD_SHIFT) != 0;
  if (CanMask() && shift) {
    ResizeBrush(std::pow(1.2, wheel.y), false);
  } else if (IsInside()) {
    ZoomPhotograph(mouse_px_, std::pow(1.2, wheel.y));
  } else if (gesture_ == Gesture::kLook) {
    fly_speed_ *= std::pow(1.25, wheel.y);
  } else {
    MoveEye(Dolly(eye_, PointUnder(mouse_px_), wheel.y));
  }
}

// They lead somewhere while the right button is held, and while one walks, which knows no up and
// down.
FlyWay App::FlyWayByKeys(std::string_view places_held) const {
  if (IsInside() || (gesture_ != Gesture::kLook && !is_walking_)) return {};
  FlyWay way = FlyWayOf(places_held);
  if (is_walking_) way.up = 0;
  return way;
}

void App::FlyByKeys(double now_ms) {
  const double seconds = std::min(0.1, (now_ms - last_fly_ms_) / 1000);
  last_fly_ms_ = now_ms;
  // With Ctrl they are shortcuts.
  const bool is_shortcut = (SDL_GetModState() & (KMOD_CTRL | KMOD_ALT)) != 0;
  if (is_shortcut || IsCovered() || ImGui::GetIO().WantTextInput) return;
  const Uint8* keys = SDL_GetKeyboardState(nullptr);
  std::string held;
  for (const char place : kFlyPlaces) {
    if (keys[SDL_GetScancodeFromName(std::string(1, place).c_str())] != 0) held += place;
  }
  const auto [forward, right, up] = FlyWayByKeys(held);
  if (forward == 0 && right == 0 && up == 0) return;
  const bool is_fast = (SDL_GetModState() & KMOD_SHIFT) != 0;
  if (is_walking_) {
    // A brisk walk.
    const double step = (is_fast ? 4.5 : 1.5) / MetresPerUnit(session_.model().unit) * seconds;
    MoveEye(Walk(eye_, session_.model(), visibility_, step * forward, step * right));
    return;
  }
  const double size = ComputeBounds(session_.model()).Diagonal();
  const double step = 0.25 * size * fly_speed_ * (is_fast ? 3 : 1) * seconds;
  MoveEye(Fly(eye_, step * forward, step * right, step * up));
}

}  // namespace groundglass
