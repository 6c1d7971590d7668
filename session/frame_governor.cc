// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/frame_governor.h"

#include "scene/check_option.h"

namespace groundglass {

double FrameScale(FrameQuality quality) {
  switch (quality) {
    case FrameQuality::kTwoThirds:
      return 2.0 / 3;
    case FrameQuality::kHalf:
      return 0.5;
    default:
      return 1;
  }
}

void FrameGovernorOptions::Check() const {
  CheckAbove(too_slow_ms, 0, "frame governor options: too_slow_ms");
  CheckFromTo(fast_ms, 0, too_slow_ms, "frame governor options: fast_ms");
  CheckFromTo(fast_frames, 1, 10000, "frame governor options: fast_frames");
  CheckAbove(rest_ms, 0, "frame governor options: rest_ms");
  CheckFromTo(smoothing, 0.01, 1, "frame governor options: smoothing");
}

FrameGovernor::FrameGovernor(const FrameGovernorOptions& options) : options_(options) {
  options_.Check();
}

void FrameGovernor::Drew(FrameQuality quality, double took_ms) {
  if (quality != moving_) return;
  mean_ms_ = mean_ms_ == 0 ? took_ms : mean_ms_ + options_.smoothing * (took_ms - mean_ms_);
  num_fast_ = took_ms < options_.fast_ms ? num_fast_ + 1 : 0;
  const auto change = [&](int by) {
    moving_ = static_cast<FrameQuality>(static_cast<int>(moving_) + by);
    mean_ms_ = 0;
    num_fast_ = 0;
  };
  if (mean_ms_ > options_.too_slow_ms && moving_ != FrameQuality::kHalf) {
    change(1);
  } else if (num_fast_ >= options_.fast_frames && moving_ != FrameQuality::kSmooth) {
    change(-1);
  }
}

}  // namespace groundglass
