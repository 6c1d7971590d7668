// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/scene_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::HasSubstr;

JudgedPhotograph Judged(Verdict verdict, double end_px, std::optional<bool> is_inside_95) {
  JudgedPhotograph photograph;
  photograph.verdict = verdict;
  photograph.start_px = 10;
  photograph.end_px = end_px;
  photograph.is_wrong_accepted = verdict == Verdict::kAccepted && end_px > 3;
  photograph.is_inside_95 = is_inside_95;
  return photograph;
}

TEST(SceneSummary, CountsVerdictsAndTakesErrorsOfWhatIsAccepted) {
  const JudgedScene scene{"hall",
                          {Judged(Verdict::kAccepted, 0.5, true),
                           Judged(Verdict::kAccepted, 1.5, false),
                           Judged(Verdict::kAccepted, 7, true),
                           Judged(Verdict::kReview, 40, std::nullopt),
                           Judged(Verdict::kRejected, 90, std::nullopt)}};
  const SceneSummary summary = SummariseScene(scene);
  EXPECT_EQ(summary.count, 5);
  EXPECT_EQ(summary.num_accepted, 3);
  EXPECT_EQ(summary.num_review, 1);
  EXPECT_EQ(summary.num_rejected, 1);
  EXPECT_EQ(summary.num_wrong_accepted, 1);
  EXPECT_EQ(summary.num_inside_95, 2);
  EXPECT_EQ(summary.num_calibrated, 3);
  EXPECT_EQ(summary.median_px, 1.5);
  EXPECT_EQ(summary.worst_px, 7);
  EXPECT_EQ(summary.median_start_px, 10);
}

// Without registration.json there are errors and no verdicts.
TEST(SceneSummary, TakesAllWhereNothingIsJudged) {
  JudgedScene scene{"tags", {JudgedPhotograph(), JudgedPhotograph()}};
  scene.photographs[0].end_px = 2;
  scene.photographs[1].end_px = 4;
  const SceneSummary summary = SummariseScene(scene);
  EXPECT_EQ(summary.num_accepted, 0);
  EXPECT_EQ(summary.median_px, 3);
  EXPECT_EQ(summary.worst_px, 4);
}

TEST(SceneSummary, NothingAcceptedHasNoErrors) {
  const std::vector<JudgedScene> scenes = {{"hall", {Judged(Verdict::kReview, 1, std::nullopt)}}};
  EXPECT_FALSE(SummariseScene(scenes[0]).median_px.has_value());
  EXPECT_THAT(FormatScenesTable(scenes), HasSubstr("10.00          -         -"));
  EXPECT_THAT(FormatScenesJson(scenes), HasSubstr("\"worst_px_at_640\": null"));
}

TEST(SceneSummary, BlundersOfTrialsAreLeftOut) {
  std::vector<Trial> trials(2);
  trials[0].verdict = trials[1].verdict = Verdict::kAccepted;
  trials[0].confidence = 0.97;
  trials[1].blunder = Blunder::kWrongSign;
  const JudgedScene scene = JudgedSceneOf("hall", trials);
  ASSERT_EQ(scene.photographs.size(), 1u);
  EXPECT_EQ(scene.photographs[0].is_inside_95, false);
}

TEST(SceneSummary, TableHasALineForEachSceneAndOneForAll) {
  const std::vector<JudgedScene> scenes = {{"hall", {Judged(Verdict::kAccepted, 1, true)}},
                                           {"barn", {Judged(Verdict::kAccepted, 3, false)}}};
  const std::string table = FormatScenesTable(scenes);
  EXPECT_THAT(table, HasSubstr("hall "));
  EXPECT_THAT(table, HasSubstr("barn "));
  EXPECT_THAT(table, HasSubstr("1 of 2"));
  const std::string json = FormatScenesJson(scenes);
  EXPECT_THAT(json, HasSubstr("\"name\": \"all\""));
  EXPECT_THAT(json, HasSubstr("\"median_px_at_640\": 2.0"));
}

}  // namespace
}  // namespace groundglass
