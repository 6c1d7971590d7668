// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/trials.h"

#include "scene/error.h"
#include "tests/support/brick_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

Trial TrialOf(double start_px, double end_px, Verdict verdict) {
  Trial trial;
  trial.start_at_640_px = start_px;
  trial.end_at_640_px = end_px;
  trial.verdict = verdict;
  trial.is_wrong_accepted = verdict == Verdict::kAccepted && end_px > 3;
  return trial;
}

TEST(SummariseTrials, CountsByStartingErrorAndAllTogether) {
  const std::vector<TrialBin> bins = SummariseTrials({TrialOf(3, 0.2, Verdict::kAccepted),
                                                      TrialOf(15, 0.4, Verdict::kAccepted),
                                                      TrialOf(16, 2.0, Verdict::kReview),
                                                      TrialOf(17, 9.0, Verdict::kAccepted)});
  ASSERT_EQ(bins.size(), 3u);  // below 5, 10 to 20, all
  EXPECT_EQ(bins[1].low_px, 10);
  EXPECT_EQ(bins[1].count, 3);
  EXPECT_EQ(bins[1].num_within_1_px, 1);
  EXPECT_EQ(bins[1].num_within_3_px, 2);
  EXPECT_EQ(bins[1].num_accepted, 2);
  EXPECT_EQ(bins[1].num_wrong_accepted, 1);
  EXPECT_EQ(bins[1].median_end_px, 2.0);
  EXPECT_EQ(bins[2].count, 4);
}

// Blunders are counted apart from what the notebooks' sigmas say.
TEST(SummariseTrials, BlundersAreCountedApart) {
  std::vector<Trial> trials = {TrialOf(3, 0.2, Verdict::kAccepted),
                               TrialOf(300, 40, Verdict::kAccepted),
                               TrialOf(200, 0.5, Verdict::kAccepted),
                               TrialOf(250, 250, Verdict::kRejected)};
  trials[1].blunder = Blunder::kWrongPhotograph;
  trials[2].blunder = trials[3].blunder = Blunder::kWrongSign;
  EXPECT_EQ(SummariseTrials(trials).back().count, 1);
  const TrialBin all = SummariseBlunders(trials, Blunder::kNone);
  EXPECT_EQ(all.count, 3);
  EXPECT_EQ(all.num_within_3_px, 1);
  EXPECT_EQ(all.num_wrong_accepted, 1);
  EXPECT_EQ(SummariseBlunders(trials, Blunder::kWrongPhotograph).num_wrong_accepted, 1);
  EXPECT_EQ(SummariseBlunders(trials, Blunder::kSwappedCoordinates).count, 0);
  TrialOptions options;
  options.num_blunders = 3;
  EXPECT_THAT(FormatTrialsTable(trials, options), testing::HasSubstr("wrong 1 (33.3 %)"));
}

// Notebooks differ from one another, and registration brings their tags back to the truth.
TEST(RunTrials, NotebooksOfStatedSigmasAreBroughtBack) {
  Scene scene = ReadScene(kBrick);
  scene.photographs.resize(1);
  TrialOptions options;
  options.num_trials = 2;
  const std::vector<Trial> trials = RunTrials(scene, ReadTruth(kBrick / "truth"), options, {});
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_NE(trials[0].start_px, trials[1].start_px);
  for (const Trial& trial : trials) {
    EXPECT_GT(trial.start_px, 2);
    EXPECT_LT(trial.end_px, 2);
    EXPECT_FALSE(trial.is_wrong_accepted);
    EXPECT_NEAR(trial.end_at_640_px, trial.end_px * 640 / 1200, 1e-9);
  }
}

TEST(TrialOptions, RefuseNoTrialsAndNoSigmas) {
  TrialOptions options;
  options.sigma_lookat = 0;
  EXPECT_THAT([&] { options.Check(); },
              testing::ThrowsMessage<Error>("trial options: sigma_lookat must be above 0, not 0"));
  options.num_trials = 0;
  EXPECT_THAT([&] { options.Check(); },
              testing::ThrowsMessage<Error>("trial options: num_trials must be at least 1, not 0"));
}

}  // namespace
}  // namespace groundglass
