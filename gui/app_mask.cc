// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "gui/overlay_shapes.h"
#include "session/mask_flood.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <utility>

namespace groundglass {

// The mask of the photograph that is shown; null, with a message, if there can be none.
MaskPaint* App::Mask() {
  if (photograph_ < 0) return nullptr;
  try {
    return &masks_.Paint(photograph_);
  } catch (const std::exception& error) {
    message_ = error.what();
    return nullptr;
  }
}

// What the picture shows of it; null where there is none, or in another mode.
std::shared_ptr<const Image8> App::ShownMask() {
  if (!CanMask()) return nullptr;
  const MaskPaint* mask = Mask();
  if (mask == nullptr) return nullptr;
  if (mask_of_ != photograph_ || mask_version_ != mask->version() || !mask_shown_) {
    mask_shown_ = std::make_shared<const Image8>(mask->ignore());
    const auto& values = mask_shown_->values;
    mask_share_ = static_cast<double>(std::count(values.begin(), values.end(), 255)) /
                  static_cast<double>(values.size());
    mask_of_ = photograph_;
    mask_version_ = mask->version();
  }
  return mask_shown_;
}

void App::PressInMask(const Eigen::Vector2d& pane_px, int button, bool is_double, bool shift) {
  if (button == SDL_BUTTON_MIDDLE) {
    gesture_ = Gesture::kMovePhotograph;
    return;
  }
  MaskPaint* mask = Mask();
  if (mask == nullptr) return;
  is_erasing_ = button == SDL_BUTTON_RIGHT;
  const Eigen::Vector2d at_px = place_.InPhotograph(pane_px);
  const std::optional<int> depth_before_click = std::exchange(depth_before_press_, std::nullopt);
  if (!is_double) depth_before_press_ = mask->UndoDepth();
  if (shift) {
    gesture_ = Gesture::kLasso;
    lasso_px_ = {at_px};
    return;
  }
  const auto picture = cache_.Find(photograph_);
  if (is_double && picture) {
    // In place of the dab of the first click, if that changed anything.
    if (depth_before_click && mask->UndoDepth() > *depth_before_click) mask->Undo();
    StartFlood(picture, at_px);
    return;
  }
  gesture_ = Gesture::kPaint;
  painted_px_ = at_px;
  mask->BeginStroke();
  DragInMask(pane_px);
}

void App::DragInMask(const Eigen::Vector2d& pane_px) {
  MaskPaint* mask = Mask();
  if (mask == nullptr) return;
  const Eigen::Vector2d at_px = place_.InPhotograph(pane_px);
  if (gesture_ == Gesture::kLasso) {
    if ((at_px - lasso_px_.back()).norm() * place_.scale > 2) lasso_px_.push_back(at_px);
    return;
  }
  const double radius_px = (is_erasing_ ? eraser_px_ : brush_px_) / place_.scale;
  mask->Brush(painted_px_, at_px, radius_px, !is_erasing_);
  painted_px_ = at_px;
  governor_.Moved(NowMs());
}

void App::ReleaseInMask() {
  MaskPaint* mask = Mask();
  if (mask == nullptr) return;
  if (gesture_ == Gesture::kLasso) mask->Lasso(lasso_px_, !is_erasing_);
  if (gesture_ == Gesture::kPaint) mask->EndStroke();
  lasso_px_.clear();
}

// Ends a stroke or a lasso where it is.
void App::LetGoOfMask() {
  depth_before_press_.reset();
  if (gesture_ != Gesture::kPaint && gesture_ != Gesture::kLasso) return;
  if (MaskPaint* mask = Mask(); mask != nullptr && gesture_ == Gesture::kPaint) mask->EndStroke();
  lasso_px_.clear();
  gesture_ = Gesture::kNone;
}

void App::ResizeBrush(double factor, bool is_eraser) {
  double& radius_px = is_eraser ? eraser_px_ : brush_px_;
  radius_px = std::clamp(radius_px * factor, 1.0, 300.0);
}

// On a thread of its own, since a large scan takes longer than one should wait for.
void App::StartFlood(const std::shared_ptr<const Image8>& picture, const Eigen::Vector2d& from_px) {
  FinishFlood();
  flooded_photograph_ = photograph_;
  flood_erases_ = is_erasing_;
  message_ = "filling up to the edges of the picture ...";
  flood_.Start([picture, from_px] { return FindFlood(*picture, from_px); }, [this] { WakeUp(); });
}

void App::TakeFlood() {
  // A stroke that is under way stays one step.
  if (gesture_ == Gesture::kPaint) return;
  if (const auto flood = flood_.Take()) ShowFlood(*flood);
}

// For what must know of it: saving, closing.
void App::FinishFlood() {
  if (const auto flood = flood_.Wait()) ShowFlood(*flood);
}

void App::ShowFlood(const Image8& flood) {
  needs_frame_ = true;
  const auto filled = std::count(flood.values.begin(), flood.values.end(), 255);
  masks_.Paint(flooded_photograph_).Fill(flood, !flood_erases_);
  char text[96];
  std::snprintf(text,
                sizeof text,
                "%s %.1f %% of the photograph \u00B7 Ctrl+Z takes it back",
                flood_erases_ ? "erased" : "filled",
                100.0 * static_cast<double>(filled) /
                    static_cast<double>(std::max<size_t>(1, flood.values.size())));
  message_ = text;
}

// Undo, redo and saving in this mode are the mask's; others stay as they are.
bool App::DoInMask(Action action) {
  constexpr double kStep = 1.25;
  MaskPaint* mask = Mask();
  // A mask that cannot be read is nothing to undo or save, and so is what lies behind it.
  if (mask == nullptr) {
    return action == Action::kUndo || action == Action::kRedo || action == Action::kSave;
  }
  switch (action) {
    case Action::kUndo:
      if (flood_.IsRunning() && flooded_photograph_ == photograph_) {
        flood_.Drop();
        message_ = "nothing is filled";
        return true;
      }
      if (!mask->Undo()) message_ = "nothing to undo in this mask";
      return true;
    case Action::kRedo:
      if (!mask->Redo()) message_ = "nothing to do again in this mask";
      return true;
    case Action::kSave:
      SaveMask(false);
      return true;
    case Action::kBrushLarger:
      ResizeBrush(kStep, false);
      return true;
    case Action::kBrushSmaller:
      ResizeBrush(1 / kStep, false);
      return true;
    case Action::kEraserLarger:
      ResizeBrush(kStep, true);
      return true;
    case Action::kEraserSmaller:
      ResizeBrush(1 / kStep, true);
      return true;
    default:
      return false;
  }
}

void App::SaveMask(bool over_others) {
  FinishFlood();
  const SaveResult result = masks_.Save(photograph_, over_others);
  message_ = result.message;
  asks_to_overwrite_mask_ = result.kind == SaveResult::Kind::kChangedOnDisk;
}

void App::DrawMaskTools() {
  const auto on_screen = [&](const Eigen::Vector2d& photograph_px) {
    const Eigen::Vector2d at = place_.InPicture(photograph_px);
    return ImVec2(static_cast<float>(pane_.x + at.x()), static_cast<float>(pane_.y + at.y()));
  };
  for (size_t i = 0; i + 1 < lasso_px_.size(); ++i) {
    OverlayLine(on_screen(lasso_px_[i]), on_screen(lasso_px_[i + 1]), kOverlayYellow, 1.5f);
  }
  const bool is_over = pane_.Holds(mouse_x_, mouse_y_) && !IsCovered();
  if (!is_over || gesture_ == Gesture::kLasso) return;
  const bool is_eraser = gesture_ == Gesture::kPaint && is_erasing_;
  const ImVec2 at(static_cast<float>(pane_.x + mouse_px_.x()),
                  static_cast<float>(pane_.y + mouse_px_.y()));
  OverlayRing(at,
              static_cast<float>(is_eraser ? eraser_px_ : brush_px_),
              is_eraser ? kOverlayGrey : kOverlayYellow);
}

void App::DrawMaskPanel() {
  const MaskPaint* mask = Mask();
  if (mask == nullptr) {
    ImGui::TextWrapped("Choose a photograph.");
    return;
  }
  ImGui::TextWrapped(
      "What is hatched is not looked at: people, trees, a slide's mount. It is saved as "
      "masks/%s.png, which register, run and invrender read.",
      session_.photographs()[photograph_].name.c_str());
  ImGui::Separator();
  const auto size = [](const char* label, double& radius_px) {
    float diameter = static_cast<float>(2 * radius_px);
    if (ImGui::SliderFloat(label, &diameter, 2, 600, "%.0f px", ImGuiSliderFlags_Logarithmic)) {
      radius_px = diameter / 2;
    }
  };
  size("brush", brush_px_);
  size("eraser", eraser_px_);
  ImGui::TextWrapped("[ and ] change the brush, with Shift the eraser.");
  ImGui::Text("%.1f %% of the photograph is masked", 100 * mask_share_);
  if (ImGui::Button("Ctrl+S save the mask")) SaveMask(false);
}

}  // namespace groundglass
