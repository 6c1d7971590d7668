// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/notebook.h"
#include "evaluate/truth.h"
#include "register/register.h"
#include "scene/formats/scene_folder.h"
#include "scene/progress.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct TrialOptions {
  int num_trials = 10;  // notebooks, each with a tag for every photograph
  uint64_t seed = 1988;
  // One standard deviation of what each notebook's errors are drawn from, in the model's unit; it
  // is stated in the tags, so that priors match the starts. Roll, shift and scale are the slides'
  // own, and never written down.
  double sigma_position = 0.15;
  double sigma_height = 0.05;
  double sigma_lookat = 0.3;
  // The tags state standard deviations that are so many times smaller than these; 1: the same.
  double overclaim = 1;
  // How many tags of each notebook hold a blunder; they are counted apart.
  int num_blunders = 0;
  RegisterOptions registration;

  void Check() const;  // throws Error naming the first field out of range
};

// One photograph registered from one notebook's tag. Vertex errors as measured, and in proportion
// at 640 px wide.
struct Trial {
  std::string name;
  int notebook = 0;
  double start_px = 0;
  double end_px = 0;
  double start_at_640_px = 0;
  double end_at_640_px = 0;
  double position_error = 0;  // model's unit
  double position_sigma = 0;  // claimed; 0 where nothing is
  Blunder blunder = Blunder::kNone;
  Verdict verdict = Verdict::kRejected;
  bool is_wrong_accepted = false;
  // Calibration::confidence, where a covariance is judged.
  std::optional<double> confidence;
  bool IsInside95() const { return confidence && *confidence <= 0.95; }
};

// Registers the scene's photographs from many notebooks. Photographs without truth are left out.
// Throws Error.
std::vector<Trial> RunTrials(const Scene& scene,
                             const Truth& truth,
                             const TrialOptions& options,
                             const Progress& progress);

// Trials with a starting error in [low, high) at 640 px wide.
struct TrialBin {
  double low_px = 0;
  double high_px = 0;
  int count = 0;
  int num_within_1_px = 0;  // at 640 wide
  int num_within_3_px = 0;
  int num_accepted = 0;
  int num_wrong_accepted = 0;
  int num_calibrated = 0;
  int num_inside_95 = 0;
  double median_end_px = 0;  // at 640 wide
};
// Bins of starting error: below 5, 10, 20, 40 px and beyond; then all together. Empty ones left
// out. Blunders are not among them.
std::vector<TrialBin> SummariseTrials(const std::vector<Trial>& trials);
// The blunders of one kind together; of all kinds for kNone.
TrialBin SummariseBlunders(const std::vector<Trial>& trials, Blunder kind);

std::string FormatTrialsTable(const std::vector<Trial>& trials, const TrialOptions& options);
std::string FormatTrialsJson(const std::vector<Trial>& trials, const TrialOptions& options);

}  // namespace groundglass
