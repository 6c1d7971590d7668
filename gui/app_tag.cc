// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "scene/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

constexpr double kReachPx = 12;
constexpr double kEdgeReachPx = 7;

}  // namespace

void App::ChangePins(const Pins& pins, const std::string& gesture) {
  PhotographWork work = session_.work(photograph_);
  work.pins = pins;
  // A camera that was found or taken before does not know of these pins.
  work.alignment.reset();
  work.accepted.reset();
  work.overruled.clear();
  session_.Change(photograph_, std::move(work), gesture);
}

// What is under way on pins that may not be there any more, or on this photograph's mask.
void App::LetGo() {
  pin_.reset();
  armed_point_.reset();
  new_line_.reset();
  pin_is_due_ = false;
  if (gesture_ == Gesture::kPin || gesture_ == Gesture::kLine || gesture_ == Gesture::kNewPin) {
    gesture_ = Gesture::kNone;
  }
  LetGoOfMask();
}

bool App::HasPin(const Pins& pins) const {
  return pin_ && *pin_ >= 0 && static_cast<size_t>(*pin_) < pins.points.size() + pins.lines.size();
}

void App::PlacePin(const Eigen::Vector3d& point_in_world, const Eigen::Vector2d& image_px) {
  Pins pins = session_.work(photograph_).pins;
  const auto same = std::find_if(pins.points.begin(), pins.points.end(), [&](const PointPin& pin) {
    return pin.point_in_world == point_in_world;
  });
  // A corner has one place in a photograph.
  pin_ = static_cast<int>(same - pins.points.begin());
  if (same == pins.points.end()) {
    pins.points.push_back(
        {point_in_world, image_px, session_.options().pin_sigma_px, PinUse::kUsed});
  } else {
    same->image_px = image_px;
  }
  ChangePins(pins, "pin " + std::to_string(gesture_number_));
}

// Corners that are seen and have no pin yet.
std::vector<VisibleCorner> App::UnpinnedCorners() {
  std::vector<VisibleCorner> corners = Corners();
  std::erase_if(corners, [&](const VisibleCorner& corner) {
    const Eigen::Vector3d& point = session_.model().points_in_world[corner.point];
    const std::vector<PointPin>& pins = session_.work(photograph_).pins.points;
    return std::any_of(
        pins.begin(), pins.end(), [&](const PointPin& pin) { return pin.point_in_world == point; });
  });
  return corners;
}

void App::PressInTag(const Eigen::Vector2d& pane_px) {
  ++gesture_number_;
  session_.EndGesture();
  const Pins& pins = session_.work(photograph_).pins;
  const std::optional<VisibleCorner> corner =
      armed_point_ ? std::nullopt : PickCorner(UnpinnedCorners(), pane_px, kReachPx);
  double nearest_px = corner ? (corner->image_px - pane_px).norm() : kReachPx;
  if (armed_point_) nearest_px = 0;
  for (size_t i = 0; i < pins.points.size(); ++i) {
    const double distance = (place_.InPicture(pins.points[i].image_px) - pane_px).norm();
    if (distance > nearest_px) continue;
    nearest_px = distance;
    pin_ = static_cast<int>(i);
    gesture_ = Gesture::kPin;
  }
  if (gesture_ == Gesture::kPin) return;
  for (size_t i = 0; i < pins.lines.size(); ++i) {
    for (int end = 0; end < 2; ++end) {
      const Eigen::Vector2d& at = end == 0 ? pins.lines[i].first_px : pins.lines[i].second_px;
      if ((place_.InPicture(at) - pane_px).norm() > kReachPx) continue;
      pin_ = static_cast<int>(pins.points.size() + i);
      line_end_ = end;
      gesture_ = Gesture::kLine;
      return;
    }
  }
  if (armed_point_) {
    gesture_ = Gesture::kNewPin;
    return;
  }
  if (corner) {
    armed_point_ = corner->point;
    gesture_ = Gesture::kNewPin;
    return;
  }
  if (!PhotographCamera()) return;
  const Camera camera = PaneCamera();
  const auto spans = FindVisibleSpans(session_.model(), edges_, visibility_, camera, 0);
  if (const auto span = PickSpan(spans, camera, pane_px, kEdgeReachPx)) {
    // It becomes a pin when it is dragged; a click leaves it alone.
    LinePin line;
    line.start_in_world = spans[*span].start_in_world;
    line.end_in_world = spans[*span].end_in_world;
    line.first_px = place_.InPhotograph(*Project(camera, line.start_in_world));
    line.second_px = place_.InPhotograph(*Project(camera, line.end_in_world));
    line.sigma_px = session_.options().pin_sigma_px;
    new_line_ = line;
    line_end_ = -1;
    gesture_ = Gesture::kLine;
    return;
  }
  pin_.reset();
}

void App::DragInTag(const Eigen::Vector2d& pane_px, const Eigen::Vector2d& by_px, bool is_slow) {
  if (!has_moved_) return;
  Pins pins = session_.work(photograph_).pins;
  const Eigen::Vector2d by = by_px / place_.scale * (is_slow ? 0.1 : 1);
  if (gesture_ == Gesture::kNewPin && armed_point_) {
    PlacePin(session_.model().points_in_world[*armed_point_], place_.InPhotograph(pane_px));
    return;
  }
  if (gesture_ == Gesture::kPin && HasPin(pins)) {
    pins.points[*pin_].image_px += by;
    ChangePins(pins, "pin " + std::to_string(gesture_number_));
  } else if (gesture_ == Gesture::kLine) {
    if (new_line_) {
      pins.lines.push_back(*new_line_);
      new_line_.reset();
      pin_ = static_cast<int>(pins.points.size() + pins.lines.size()) - 1;
    }
    if (!HasPin(pins)) return;
    LinePin& line = pins.lines[*pin_ - pins.points.size()];
    if (line_end_ != 1) line.first_px += by;
    if (line_end_ != 0) line.second_px += by;
    ChangePins(pins, "line " + std::to_string(gesture_number_));
  }
}

void App::ReleaseInTag(const Eigen::Vector2d& pane_px) {
  new_line_.reset();
  if (gesture_ == Gesture::kNewPin && armed_point_) {
    const Eigen::Vector3d& point = session_.model().points_in_world[*armed_point_];
    const Eigen::Vector2d* seen = nullptr;
    for (const VisibleCorner& corner : corners_) {
      if (corner.point == *armed_point_) seen = &corner.image_px;
    }
    // A click on the corner itself takes it; the next click says where it is in the photograph.
    const bool is_first_click =
        !has_moved_ && seen != nullptr && (*seen - pane_px).norm() <= kReachPx && !pin_is_due_;
    if (is_first_click) {
      pin_is_due_ = true;
    } else {
      PlacePin(point, place_.InPhotograph(pane_px));
      armed_point_.reset();
      pin_is_due_ = false;
    }
  }
  session_.EndGesture();
}

void App::StandThere(const Eigen::Vector3d& stood_in_world,
                     const Eigen::Vector3d& looked_in_world) {
  const ImageSize& size = session_.photographs()[photograph_].size;
  if (size.width == 0 || (looked_in_world - stood_in_world).head<2>().norm() < 1e-6) return;
  PhotographWork work = session_.work(photograph_);
  work.tag = RoughTag(stood_in_world,
                      looked_in_world,
                      size.width,
                      size.height,
                      IsCropped(),
                      session_.options().rough);
  work.alignment.reset();
  work.accepted.reset();
  work.overruled.clear();
  session_.Change(photograph_, std::move(work));
  session_.EndGesture();
}

void App::StandAsLooking() {
  const double distance =
      (ComputeBounds(session_.model()).Center() - eye_.position_in_world).norm();
  StandThere(eye_.position_in_world, eye_.position_in_world + distance * eye_.Forward());
}

bool App::IsCropped() const {
  const auto& tag = session_.work(photograph_).tag;
  return tag && IsOfCroppedPicture(*tag, session_.options().rough);
}

void App::ToggleCropped() {
  PhotographWork work = session_.work(photograph_);
  if (!work.tag) return;
  const RoughPlaceOptions& rough = session_.options().rough;
  work.tag->sigmas.shift = IsCropped() ? rough.shift : rough.cropped_shift;
  work.alignment.reset();
  work.accepted.reset();
  work.overruled.clear();
  session_.Change(photograph_, std::move(work));
}

void App::NudgePin(const KeyPress& press) {
  Pins pins = session_.work(photograph_).pins;
  if (!HasPin(pins)) return;
  const double step = press.ctrl ? 10 : press.shift ? 1 : 0.1;
  Eigen::Vector2d by(0, 0);
  if (press.key == "Left") by.x() = -step;
  if (press.key == "Right") by.x() = step;
  if (press.key == "Up") by.y() = -step;
  if (press.key == "Down") by.y() = step;
  const size_t index = *pin_;
  if (index < pins.points.size()) {
    pins.points[index].image_px += by;
  } else {
    LinePin& line = pins.lines[index - pins.points.size()];
    if (line_end_ != 1) line.first_px += by;
    if (line_end_ != 0) line.second_px += by;
  }
  ChangePins(pins, "nudge " + std::to_string(index));
}

void App::StepCorner(int by) {
  const std::vector<VisibleCorner>& corners = Corners();
  if (corners.empty()) return;
  const int count = static_cast<int>(corners.size());
  int at = by > 0 ? -1 : count;
  for (int i = 0; armed_point_ && i < count; ++i) {
    if (corners[i].point == *armed_point_) at = i;
  }
  armed_point_ = corners[(at + by + count) % count].point;
  pin_is_due_ = true;
  pin_.reset();
}

void App::TakeCorner() {
  if (!armed_point_) {
    pin_.reset();
    session_.EndGesture();
    return;
  }
  for (const VisibleCorner& corner : Corners()) {
    if (corner.point != *armed_point_) continue;
    ++gesture_number_;
    PlacePin(session_.model().points_in_world[*armed_point_], place_.InPhotograph(corner.image_px));
    session_.EndGesture();
    break;
  }
  armed_point_.reset();
  pin_is_due_ = false;
}

void App::CycleUse() {
  Pins pins = session_.work(photograph_).pins;
  if (!HasPin(pins)) return;
  const size_t index = *pin_;
  PinUse& use = index < pins.points.size() ? pins.points[index].use
                                           : pins.lines[index - pins.points.size()].use;
  use = use == PinUse::kUsed    ? PinUse::kCheck
        : use == PinUse::kCheck ? PinUse::kOff
                                : PinUse::kUsed;
  ChangePins(pins);
}

void App::RemovePin() {
  Pins pins = session_.work(photograph_).pins;
  if (!HasPin(pins)) return;
  const size_t index = *pin_;
  if (index < pins.points.size()) {
    pins.points.erase(pins.points.begin() + static_cast<std::ptrdiff_t>(index));
  } else {
    pins.lines.erase(pins.lines.begin() + static_cast<std::ptrdiff_t>(index - pins.points.size()));
  }
  LetGo();
  ChangePins(pins);
}

void App::Align() {
  if (alignment_.IsRunning()) return;
  const PhotographWork& work = session_.work(photograph_);
  const auto& solution = session_.Solution(photograph_);
  if (!work.tag || !solution) {
    message_ = "first say on the plan where it was taken: press, drag, release";
    return;
  }
  // The camera of the pins, as unsure as it was before them: they are told apart from it.
  ViewTag tag = solution->tag;
  tag.sigmas = work.tag->sigmas;
  aligned_photograph_ = photograph_;
  aligned_work_ = work;
  alignment_.Start(
      session_.photographs()[photograph_], tag, work.pins, session_.model(), [this] { WakeUp(); });
  message_.clear();
}

void App::StopAlignment() {
  alignment_.Stop();
  message_ = "stopped: " + session_.photographs()[aligned_photograph_].name + " is as it was";
}

void App::TakeAlignment() {
  try {
    std::optional<AlignmentNews> news = alignment_.Take();
    if (!news) return;
    needs_frame_ = true;
    PhotographWork work = session_.work(aligned_photograph_);
    if (!(work.tag == aligned_work_.tag) || !(work.pins == aligned_work_.pins)) {
      message_ = session_.photographs()[aligned_photograph_].name +
                 " was changed while it was aligned: A aligns again";
      return;
    }
    work.alignment = std::move(*news);
    work.accepted.reset();
    work.overruled.clear();
    message_ = session_.photographs()[aligned_photograph_].name + ": " +
               std::string(VerdictName(work.alignment->verdict));
    if (work.alignment->verdict == Verdict::kAccepted) work.accepted = work.alignment->corrected;
    session_.Change(aligned_photograph_, std::move(work));
    session_.EndGesture();
  } catch (const std::exception& error) {
    needs_frame_ = true;
    message_ = std::string("not aligned: ") + error.what();
  }
}

void App::Accept(bool against_verdict) {
  PhotographWork work = session_.work(photograph_);
  if (!work.alignment) {
    message_ = "nothing is found yet: A aligns";
    return;
  }
  if (work.alignment->verdict != Verdict::kAccepted && !against_verdict) {
    message_ = "it is not accepted; Ctrl+Shift+Enter takes it all the same, with a reason";
    return;
  }
  if (against_verdict && reason_.empty()) {
    asks_reason_ = true;
    return;
  }
  work.accepted = work.alignment->corrected;
  work.overruled = against_verdict ? reason_ : "";
  reason_.clear();
  session_.Change(photograph_, std::move(work));
  session_.EndGesture();
}

void App::BackToNotebook() {
  session_.BackToNotebook(photograph_);
  session_.EndGesture();
  LetGo();
  message_ = session_.photographs()[photograph_].name + " is as the notebook has it";
}

void App::Save() {
  if (photograph_ < 0) return;
  const SaveResult result = session_.Save(photograph_);
  message_ = result.message;
  asks_to_overwrite_ = result.kind == SaveResult::Kind::kChangedOnDisk;
}

}  // namespace groundglass
