// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "scene/building_bounds.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

constexpr double kArrowPx = 25;  // an arrow key turns as far as the hand does over so many px

// The key as the bindings' table writes it, and where it is on the keyboard.
KeyPress PressOf(const SDL_Keysym& key) {
  KeyPress press;
  press.key = SDL_GetKeyName(key.sym);
  press.place = SDL_GetScancodeName(key.scancode);
  if (press.key == "Keypad Enter") press.key = "Return";
  press.shift = (key.mod & KMOD_SHIFT) != 0;
  press.ctrl = (key.mod & KMOD_CTRL) != 0;
  press.alt = (key.mod & KMOD_ALT) != 0;
  return press;
}

}  // namespace

std::vector<BindingPlace> App::Places() const {
  std::vector<BindingPlace> places = {BindingPlace::kEverywhere};
  places.push_back(IsInside() ? BindingPlace::kPhotograph : BindingPlace::kLook);
  if (mode_ == WindowMode::kTag && IsInside()) places.push_back(BindingPlace::kTag);
  if (mode_ == WindowMode::kAsk) places.push_back(BindingPlace::kAsk);
  if (CanMask()) places.push_back(BindingPlace::kMask);
  return places;
}

void App::HandleKey(const SDL_KeyboardEvent& key) {
  const KeyPress press = PressOf(key.keysym);
  // A text field keeps what is typed to itself; that of the help has the keyboard from the start.
  if ((shows_help_ || ImGui::GetIO().WantTextInput) && IsForText(press)) return;
  if (key.type == SDL_KEYUP) {
    KeyPress alone;
    alone.key = press.key;
    alone.place = press.place;
    constexpr std::array<BindingPlace, 1> kThere = {BindingPlace::kPhotograph};
    const Binding* binding = FindBinding(alone, kThere);
    if (binding != nullptr && binding->action == Action::kPhotographAlone) {
      photograph_alone_ = false;
    }
    return;
  }
  if (press.key == "Pause") {
    wants_fence_ = true;
    return;
  }
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId)) {
    says_yes_ = press.key == "Return";
    says_no_ = press.key == "Escape";
    says_drop_ = press.key == "Delete";
    return;
  }
  // What flies now means nothing else: E is up, and not the ellipsoids.
  if (!press.ctrl && !press.alt && FlyWayByKeys(press.place) != FlyWay()) return;
  const std::vector<BindingPlace> places = Places();
  if (const Binding* binding = FindBinding(press, places)) {
    Do(binding->action, press);
  } else if (IsInside() && mode_ == WindowMode::kLook) {
    DoBehindPhotograph(press);
  }
}

void App::Do(Action action, const KeyPress& press) {
  if (CanMask() && DoInMask(action)) return;
  if (DoEverywhere(action)) return;
  if (mode_ == WindowMode::kAsk && action == Action::kCopyCsv) {
    if (answer_) {
      SDL_SetClipboardText(FormatAnswerCsv(survey_, *answer_).c_str());
      message_ = "the answer is copied as CSV";
    }
    return;
  }
  if (CanTag() && DoInTag(action, press)) return;
  if (IsInside()) {
    DoInPhotograph(action);
  } else {
    DoInLook(action, press);
  }
}

bool App::DoEverywhere(Action action) {
  const auto set_mode = [&](WindowMode mode) {
    LetGoOfMask();
    mode_ = mode;
    const bool needs_photograph = mode == WindowMode::kTag || mode == WindowMode::kMask;
    if (needs_photograph && photograph_ < 0 && !session_.photographs().empty()) photograph_ = 0;
    if (needs_photograph && photograph_ >= 0) Choose(photograph_, true);
  };
  switch (action) {
    case Action::kHelp:
      shows_help_ = !shows_help_;
      return true;
    case Action::kLookMode:
      set_mode(WindowMode::kLook);
      return true;
    case Action::kTagMode:
      set_mode(WindowMode::kTag);
      return true;
    case Action::kAskMode:
      set_mode(WindowMode::kAsk);
      return true;
    case Action::kMaskMode:
      set_mode(WindowMode::kMask);
      return true;
    case Action::kUndo:
      if (photograph_ >= 0 && !session_.Undo(photograph_)) message_ = "nothing to undo";
      LetGo();
      return true;
    case Action::kRedo:
      if (photograph_ >= 0 && !session_.Redo(photograph_)) message_ = "nothing to do again";
      LetGo();
      return true;
    case Action::kSave:
      Save();
      return true;
    case Action::kQuit:
      Quit();
      return true;
    case Action::kCancel:
      Cancel();
      return true;
    case Action::kScreenshot:
      wants_screenshot_ = true;
      return true;
    case Action::kLargerText:
      new_text_scale_ = std::min(3.0, text_scale_ * 1.15);
      return true;
    case Action::kSmallerText:
      new_text_scale_ = std::max(0.6, text_scale_ / 1.15);
      return true;
    case Action::kUsualText:
      new_text_scale_ = 1;
      return true;
    case Action::kNextPhotograph:
      StepPhotograph(1);
      return true;
    case Action::kPreviousPhotograph:
      StepPhotograph(-1);
      return true;
    case Action::kNextWithoutTag:
      NextWithoutTag();
      return true;
    case Action::kHidePanels:
      has_panels_ = !has_panels_;
      return true;
    default:
      return false;
  }
}

void App::Cancel() {
  if (shows_help_) {
    shows_help_ = false;
  } else if (alignment_.IsRunning()) {
    StopAlignment();
  } else if (is_playing_) {
    is_playing_ = false;
  } else if (armed_point_ || pin_ || gesture_ == Gesture::kRough) {
    armed_point_.reset();
    pin_is_due_ = false;
    pin_.reset();
    gesture_ = Gesture::kNone;
  } else if (!places_.empty()) {
    places_.clear();
    AskAgain();
  } else if (IsInside()) {
    Leave();
    if (mode_ == WindowMode::kTag || mode_ == WindowMode::kMask) mode_ = WindowMode::kLook;
  }
}

void App::FramePickedFace() {
  if (!picked_) return;
  Box box = {Eigen::Vector3d::Constant(1e300), Eigen::Vector3d::Constant(-1e300)};
  for (const int point : session_.model().faces[picked_->face].points) {
    box.min = box.min.cwiseMin(session_.model().points_in_world[point]);
    box.max = box.max.cwiseMax(session_.model().points_in_world[point]);
  }
  eyes_before_.push_back(eye_);
  MoveEye(FrameBox(eye_, box, static_cast<double>(pane_.width) / pane_.height));
}

void App::TurnByArrow(const std::string& key) {
  const double right = key == "Right" ? 1 : key == "Left" ? -1 : 0;
  const double down = key == "Down" ? 1 : key == "Up" ? -1 : 0;
  if (is_walking_) {
    constexpr double kStepM = 0.6;
    constexpr double kTurnDeg = 5;
    eye_.yaw_deg -= kTurnDeg * right;
    const double step = kStepM / MetresPerUnit(session_.model().unit);
    MoveEye(Walk(eye_, session_.model(), visibility_, -step * down, 0));
  } else {
    const Eigen::Vector3d about = ComputeBounds(session_.model()).Center();
    MoveEye(Orbit(eye_, about, kArrowPx * right, kArrowPx * down));
  }
}

bool App::DoInLook(Action action, const KeyPress& press) {
  if (ColourFaces(action)) return true;
  const Eigen::Vector2d middle(pane_.width / 2.0, pane_.height / 2.0);
  const auto keep_eye = [&] { eyes_before_.push_back(eye_); };
  const double aspect = static_cast<double>(pane_.width) / pane_.height;
  switch (action) {
    case Action::kKeyframe:
      AddKeyframe();
      return true;
    case Action::kPlay:
      PlayFlight();
      return true;
    case Action::kRemoveKeyframe:
      RemoveKeyframe();
      return true;
    case Action::kEllipsoids:
      shows_ellipsoids_ = !shows_ellipsoids_;
      return true;
    case Action::kEdges:
      shows_edges_ = !shows_edges_;
      return true;
    case Action::kStations:
      shows_stations_ = !shows_stations_;
      return true;
    case Action::kWritten:
      shows_written_ = !shows_written_;
      return true;
    case Action::kFrame:
      FramePickedFace();
      return true;
    case Action::kHome:
      keep_eye();
      MoveEye(FrameBox(eye_, ComputeBuildingBounds(session_.model()), aspect));
      return true;
    case Action::kBack:
      if (!eyes_before_.empty()) {
        MoveEye(eyes_before_.back());
        eyes_before_.pop_back();
      }
      return true;
    case Action::kWalk:
      is_walking_ = !is_walking_;
      if (is_walking_) MoveEye(Walk(eye_, session_.model(), visibility_, 0, 0));
      return true;
    case Action::kTowards:
      MoveEye(Dolly(eye_, PointUnder(middle), 1));
      return true;
    case Action::kAway:
      MoveEye(Dolly(eye_, PointUnder(middle), -1));
      return true;
    case Action::kFlyIn:
      if (photograph_ >= 0) Choose(photograph_, true);
      return true;
    case Action::kNudge:
      TurnByArrow(press.key);
      return true;
    default:
      return false;
  }
}

bool App::DoInPhotograph(Action action) {
  switch (action) {
    case Action::kFadeMore:
      model_share_ = std::min(1.0, model_share_ + 0.1);
      return true;
    case Action::kFadeLess:
      model_share_ = std::max(0.0, model_share_ - 0.1);
      return true;
    case Action::kPhotographAlone:
      photograph_alone_ = true;
      return true;
    case Action::kWipe:
      wipes_ = !wipes_;
      return true;
    case Action::kWritten:
      shows_written_ = !shows_written_;
      return true;
    case Action::kZoom: {
      const double before = place_.scale;
      FitPhotograph();
      const double fit = place_.scale;
      const Eigen::Vector2d middle(pane_.width / 2.0, pane_.height / 2.0);
      const bool is_fit = std::abs(before - fit) < 1e-6;
      const Eigen::Vector2d about =
          mouse_px_.x() > 0 && mouse_px_.x() < pane_.width ? mouse_px_ : middle;
      if (is_fit) ZoomPhotograph(about, 1 / fit);
      if (std::abs(before - 1) < 1e-6) ZoomPhotograph(about, 4 / fit);
      return true;
    }
    default:
      return false;
  }
}

bool App::DoInTag(Action action, const KeyPress& press) {
  switch (action) {
    case Action::kNextCorner:
      StepCorner(1);
      return true;
    case Action::kPreviousCorner:
      StepCorner(-1);
      return true;
    case Action::kTake:
      TakeCorner();
      return true;
    case Action::kUsePin:
      CycleUse();
      return true;
    case Action::kLoupe:
      shows_loupe_ = !shows_loupe_;
      return true;
    case Action::kRemovePin:
      RemovePin();
      return true;
    case Action::kStandHere:
      StandAsLooking();
      return true;
    case Action::kCropped:
      ToggleCropped();
      return true;
    case Action::kAlign:
      Align();
      return true;
    case Action::kAccept:
      Accept(false);
      return true;
    case Action::kOverrule:
      Accept(true);
      return true;
    case Action::kSnap:
      SnapPin();
      return true;
    case Action::kRival:
      ShowRival();
      return true;
    case Action::kNotebook:
      BackToNotebook();
      return true;
    case Action::kNudge:
      NudgePin(press);
      return true;
    default:
      return false;
  }
}

}  // namespace groundglass
