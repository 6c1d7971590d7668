// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/shared_conflict.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// So many accepted photographs, the first of them with a conflict at the picture's half size.
std::vector<PhotographAlignment> AcceptedOnes(int num_photographs, int num_in_conflict) {
  std::vector<PhotographAlignment> alignments(num_photographs);
  for (int i = 0; i < num_photographs; ++i) {
    alignments[i].registration.verdict = Verdict::kAccepted;
    alignments[i].registration.width_px = 1200;
    alignments[i].aligned.width_px = 600;
    alignments[i].aligned.found.resize(1);
    if (i < num_in_conflict) alignments[i].conflict = EdgeConflict{false, 5, 60};
  }
  return alignments;
}

TEST(JudgeSharedConflict, WhatHalfThePhotographsShowIsTheModelsFault) {
  std::vector<PhotographAlignment> alignments = AcceptedOnes(4, 2);
  JudgeSharedConflict({}, alignments);
  EXPECT_EQ(alignments[0].registration.verdict, Verdict::kReview);
  ASSERT_EQ(alignments[1].registration.reasons.size(), 1u);
  EXPECT_NE(alignments[1].registration.reasons[0].find("10.0 px"), std::string::npos);
  EXPECT_NE(alignments[1].registration.reasons[0].find("2 of 4 photographs"), std::string::npos);
  EXPECT_EQ(alignments[2].registration.verdict, Verdict::kAccepted);
}

TEST(JudgeSharedConflict, WhatFewShowIsNot) {
  std::vector<PhotographAlignment> alignments = AcceptedOnes(5, 2);
  JudgeSharedConflict({}, alignments);
  EXPECT_EQ(alignments[0].registration.verdict, Verdict::kAccepted);
  JudgeSharedConflict({.least_share = 0.4}, alignments);
  EXPECT_EQ(alignments[0].registration.verdict, Verdict::kReview);
}

TEST(JudgeSharedConflict, OnlyAcceptedPhotographsCount) {
  std::vector<PhotographAlignment> alignments = AcceptedOnes(3, 1);
  alignments[1].registration.verdict = Verdict::kReview;
  JudgeSharedConflict({}, alignments);
  EXPECT_EQ(alignments[0].registration.verdict, Verdict::kReview);
  std::vector<PhotographAlignment> none;
  JudgeSharedConflict({}, none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace groundglass
