// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/mask_paint.h"

#include "scene/check_option.h"
#include "scene/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace groundglass {
namespace {

constexpr uint8_t kIgnored = 255;

uint8_t CodeOf(bool is_ignored) { return is_ignored ? kIgnored : 0; }

// The nearest that a line between two places comes to a third.
double DistanceFromStroke(const Eigen::Vector2d& from,
                          const Eigen::Vector2d& to,
                          const Eigen::Vector2d& at) {
  const Eigen::Vector2d along = to - from;
  const double share =
      std::clamp((at - from).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
  return (from + share * along - at).norm();
}

}  // namespace

void MaskPaintOptions::Check() const {
  CheckAtLeast(static_cast<double>(max_history_bytes), 1, "mask paint options: max_history_bytes");
}

MaskPaint::MaskPaint(const ImageSize& size, Image8 ignore, const MaskPaintOptions& options)
    : options_(options), ignore_(std::move(ignore)) {
  options_.Check();
  if (ignore_.Empty()) ignore_ = Image8(size.width, size.height, 1);
  if (ignore_.width != size.width || ignore_.height != size.height) {
    throw Error("a mask must have its photograph's size");
  }
}

bool MaskPaint::IsEmpty() const {
  return std::none_of(
      ignore_.values.begin(), ignore_.values.end(), [](uint8_t code) { return code != 0; });
}

void MaskPaint::BeginStroke() {
  EndStroke();
  before_stroke_ = ignore_;
  is_stroke_ = true;
}

void MaskPaint::Brush(const Eigen::Vector2d& from_px,
                      const Eigen::Vector2d& to_px,
                      double radius_px,
                      bool is_ignored) {
  if (!is_stroke_) BeginStroke();
  // Half a pixel's diagonal, so that the smallest brush paints one.
  const double radius = std::max(radius_px, 0.71);
  const auto first = [&](double a, double b) {
    return std::max(0, static_cast<int>(std::floor(std::min(a, b) - radius)));
  };
  const auto last = [&](double a, double b, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(std::max(a, b) + radius)));
  };
  for (int y = first(from_px.y(), to_px.y()); y <= last(from_px.y(), to_px.y(), ignore_.height);
       ++y) {
    for (int x = first(from_px.x(), to_px.x()); x <= last(from_px.x(), to_px.x(), ignore_.width);
         ++x) {
      if (DistanceFromStroke(from_px, to_px, {x + 0.5, y + 0.5}) > radius) continue;
      *ignore_.At(x, y) = CodeOf(is_ignored);
    }
  }
  ++version_;
}

void MaskPaint::EndStroke() {
  if (!is_stroke_) return;
  is_stroke_ = false;
  Keep();
}

void MaskPaint::Lasso(const std::vector<Eigen::Vector2d>& corners_px, bool is_ignored) {
  if (corners_px.size() < 3) return;
  BeginStroke();
  for (int y = 0; y < ignore_.height; ++y) {
    // Where the row's middle crosses the line.
    std::vector<double> crossings;
    for (size_t i = 0; i < corners_px.size(); ++i) {
      const Eigen::Vector2d& a = corners_px[i];
      const Eigen::Vector2d& b = corners_px[(i + 1) % corners_px.size()];
      const double row = y + 0.5;
      if ((a.y() <= row) == (b.y() <= row)) continue;
      crossings.push_back(a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double width = ignore_.width;
      const int from = static_cast<int>(std::ceil(std::clamp(crossings[i] - 0.5, 0.0, width)));
      const int to = static_cast<int>(std::ceil(std::clamp(crossings[i + 1] - 0.5, 0.0, width)));
      for (int x = from; x < to; ++x) *ignore_.At(x, y) = CodeOf(is_ignored);
    }
  }
  ++version_;
  EndStroke();
}

void MaskPaint::Fill(const Image8& where, bool is_ignored) {
  if (where.width != ignore_.width || where.height != ignore_.height) return;
  BeginStroke();
  const uint8_t code = CodeOf(is_ignored);
  std::transform(where.values.begin(),
                 where.values.end(),
                 ignore_.values.begin(),
                 ignore_.values.begin(),
                 [code](uint8_t is_there, uint8_t before) { return is_there ? code : before; });
  ++version_;
  EndStroke();
}

void MaskPaint::Put(const std::vector<MaskStep>& steps) {
  BeginStroke();
  for (const MaskStep& step : steps) PutMaskStep(step, ignore_);
  ++version_;
  EndStroke();
}

// What the stroke changed, as a step.
void MaskPaint::Keep() {
  const std::optional<MaskPart> part = FindChangedPart(before_stroke_, ignore_);
  if (!part) return;
  done_.push_back({MaskStepOf(before_stroke_, *part), MaskStepOf(ignore_, *part)});
  undone_.clear();
  size_t bytes = 0;
  for (size_t i = done_.size(); i > 0; --i) {
    const Change& change = done_[i - 1];
    bytes += sizeof(int) * (change.before.runs.size() + change.after.runs.size());
    if (bytes <= options_.max_history_bytes || i == done_.size()) continue;
    done_.erase(done_.begin(), done_.begin() + static_cast<std::ptrdiff_t>(i));
    break;
  }
  if (on_step_) on_step_(done_.back().after);
}

void MaskPaint::Show(const MaskStep& step) {
  PutMaskStep(step, ignore_);
  ++version_;
  if (on_step_) on_step_(step);
}

bool MaskPaint::Undo() {
  EndStroke();
  if (done_.empty()) return false;
  Show(done_.back().before);
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  return true;
}

bool MaskPaint::Redo() {
  EndStroke();
  if (undone_.empty()) return false;
  Show(undone_.back().after);
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  return true;
}

}  // namespace groundglass
