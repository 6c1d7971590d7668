// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"
#include "scene/image.h"
#include "session/mask_step.h"

#include <Eigen/Dense>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace groundglass {

struct MaskPaintOptions {
  // What undo may hold; the oldest strokes go first.
  size_t max_history_bytes = size_t{64} << 20;

  void Check() const;  // throws Error naming the first field out of range
};

// A photograph's mask while somebody paints it: 255 = ignore, 0 = look (ignore_mask.h). Every
// stroke is one step that can be undone. Pixels are the photograph's; what lies outside of it is
// left out. To be used by one thread.
class MaskPaint {
 public:
  // ignore: the mask so far, of this size; empty if there is none.
  MaskPaint(const ImageSize& size, Image8 ignore, const MaskPaintOptions& options = {});

  const Image8& ignore() const { return ignore_; }
  // Grows with every change, so that one knows what to draw again.
  int version() const { return version_; }
  bool IsEmpty() const;  // nothing is ignored

  // A round brush drawn along a straight line; strokes of one BeginStroke are one step.
  void BeginStroke();
  void Brush(const Eigen::Vector2d& from_px,
             const Eigen::Vector2d& to_px,
             double radius_px,
             bool is_ignored);
  void EndStroke();
  // The inside of a closed line, by the even-odd rule; one step.
  void Lasso(const std::vector<Eigen::Vector2d>& corners_px, bool is_ignored);
  // Where a picture of the mask's size is not 0 (FindFlood); one step.
  void Fill(const Image8& where, bool is_ignored);

  // Steps that all fit, one after the other; one step.
  void Put(const std::vector<MaskStep>& steps);

  bool Undo();  // false if there is nothing to undo
  bool Redo();
  int UndoDepth() const { return static_cast<int>(done_.size()); }
  // Is told of every step once it is done, and of every one that is undone or done again: what the
  // part that it changed has become.
  void TellSteps(std::function<void(const MaskStep&)> on_step) { on_step_ = std::move(on_step); }

 private:
  // The same part of the mask before and after a step.
  struct Change {
    MaskStep before;
    MaskStep after;
  };
  void Show(const MaskStep& step);
  void Keep();

  MaskPaintOptions options_;
  Image8 ignore_;
  Image8 before_stroke_;
  bool is_stroke_ = false;
  int version_ = 0;
  std::vector<Change> done_;
  std::vector<Change> undone_;
  std::function<void(const MaskStep&)> on_step_;
};

}  // namespace groundglass
