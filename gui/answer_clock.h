// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace groundglass {

// How long the window takes from an input to the frame that shows what became of it. Times are told
// by the caller, in milliseconds of a clock of its own.
class AnswerClock {
 public:
  // In the order in which they come: an input; the picture that heeds all inputs so far is asked
  // for, or none is needed; it is drawn; it is shown.
  void Asked(double now_ms) {
    if (!asked_ms_) asked_ms_ = now_ms;
  }
  void Posted() { posted_ms_ = std::exchange(asked_ms_, std::nullopt); }
  void NothingToDraw() { asked_ms_.reset(); }
  void Drawn() { drawn_ms_ = std::exchange(posted_ms_, std::nullopt); }
  void Shown(double now_ms) {
    if (drawn_ms_) answers_ms_.push_back(now_ms - *drawn_ms_);
    drawn_ms_.reset();
  }
  // Of all pictures since this was last asked, each from the oldest input that it heeds.
  std::vector<double> Take() { return std::exchange(answers_ms_, {}); }

 private:
  std::optional<double> asked_ms_;
  std::optional<double> posted_ms_;
  std::optional<double> drawn_ms_;
  std::vector<double> answers_ms_;
};

}  // namespace groundglass
