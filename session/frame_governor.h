// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

namespace groundglass {

// How a frame is drawn, from best to quickest.
enum class FrameQuality {
  kAtRest,     // supersampled, anisotropic
  kSmooth,     // four samples
  kPlain,      // one sample
  kTwoThirds,  // one sample at two thirds of the size
  kHalf,       // at half
};
double FrameScale(FrameQuality quality);

struct FrameGovernorOptions {
  double too_slow_ms = 30;  // quality falls above this
  double fast_ms = 18;      // and rises when as many frames in a row took less
  int fast_frames = 10;
  double rest_ms = 120;    // without motion: then the best
  double smoothing = 0.4;  // of the last frame's time in the mean

  void Check() const;  // throws Error naming the first field out of range
};

// Keeps the rate while something moves, and gives the best picture when nothing does. Times are
// told by the caller, in milliseconds of a clock of its own.
class FrameGovernor {
 public:
  explicit FrameGovernor(const FrameGovernorOptions& options = {});

  void Moved(double now_ms) { last_motion_ms_ = now_ms; }
  bool IsMoving(double now_ms) const { return now_ms - last_motion_ms_ < options_.rest_ms; }
  FrameQuality QualityAt(double now_ms) const {
    return IsMoving(now_ms) ? moving_ : FrameQuality::kAtRest;
  }
  // How long a frame of the moving quality took.
  void Drew(FrameQuality quality, double took_ms);

 private:
  FrameGovernorOptions options_;
  FrameQuality moving_ = FrameQuality::kPlain;
  double last_motion_ms_ = -1e300;
  double mean_ms_ = 0;
  int num_fast_ = 0;
};

}  // namespace groundglass
