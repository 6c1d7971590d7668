// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/osu_io.h"
#include "scene/formats/scene_folder.h"
#include "session/mask_desk.h"
#include "tests/register/house.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class MasksInAJournal : public testing::Test {
 protected:
  MasksInAJournal() {
    folder_.Write("model.osu", FormatOsu(MakeHouse()));
    WriteSrgb8(folder_ / "images/s1.png", Image8(60, 40, 3, 90));
    folder_.Write("views/s1.view", "x 62 y 48 z 5 i 20 j -4 k 11 a 1.5 v 54");
  }
  Session Open() const { return Session(ScanScene(folder_.path()).scene, folder_ / "journal"); }
  static void PaintSome(MaskDesk& desk) {
    desk.Paint(0).BeginStroke();
    desk.Paint(0).Brush({30, 20}, {40, 20}, 4, true);
    desk.Paint(0).EndStroke();
  }
  // As a session leaves it that is ended after a stroke, another that is undone, and half a third.
  std::vector<uint8_t> PaintAndStop() const {
    Session session = Open();
    MaskDesk desk(session, folder_.path());
    PaintSome(desk);
    MaskPaint& paint = desk.Paint(0);
    paint.Lasso({{2, 2}, {20, 3}, {9, 30}}, true);
    paint.Undo();
    std::vector<uint8_t> left = paint.ignore().values;
    paint.BeginStroke();
    paint.Brush({50, 30}, {55, 30}, 3, true);
    return left;
  }

  TemporaryFolder folder_;
};

TEST_F(MasksInAJournal, OutliveASessionThatJustStops) {
  const std::vector<uint8_t> painted = PaintAndStop();
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  EXPECT_TRUE(session.FindLeftWork().empty()) << "tags have no part in it";
  const LeftMasks left = desk.FindLeftWork();
  ASSERT_EQ(left.steps.size(), 1u);
  EXPECT_TRUE(left.left_out.empty());
  EXPECT_TRUE(desk.Paint(0).IsEmpty()) << "nothing is taken unasked";
  desk.TakeLeftWork(left);
  EXPECT_EQ(desk.Paint(0).ignore().values, painted);
  EXPECT_EQ(desk.Paint(0).UndoDepth(), 1);
  // Taken, and stopped again before it was saved.
  Session again = Open();
  MaskDesk desk_again(again, folder_.path());
  desk_again.TakeLeftWork(desk_again.FindLeftWork());
  EXPECT_EQ(desk_again.Paint(0).ignore().values, painted);
  ASSERT_EQ(desk_again.Save(0).kind, SaveResult::Kind::kSaved);
  EXPECT_FALSE(fs::exists(folder_ / "journal")) << "what is saved leaves the journal";
}

TEST_F(MasksInAJournal, WhatIsPaintedAfterSavingGoesOntoTheSavedMask) {
  std::vector<uint8_t> painted;
  {
    Session session = Open();
    MaskDesk desk(session, folder_.path());
    PaintSome(desk);
    ASSERT_EQ(desk.Save(0).kind, SaveResult::Kind::kSaved);
    desk.Paint(0).Lasso({{2, 2}, {20, 3}, {9, 30}}, true);
    painted = desk.Paint(0).ignore().values;
  }
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  desk.TakeLeftWork(desk.FindLeftWork());
  EXPECT_EQ(desk.Paint(0).ignore().values, painted);
  // Undone to what the file says, there is nothing to offer.
  desk.Paint(0).Undo();
  Session again = Open();
  EXPECT_TRUE(MaskDesk(again, folder_.path()).FindLeftWork().steps.empty());
}

TEST_F(MasksInAJournal, AMaskThatSomebodyElseChangedSinceIsLeftAloneAndToldOf) {
  PaintAndStop();
  WriteSrgb8(folder_ / "masks/s1.png", Image8(60, 40, 1));
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  const LeftMasks left = desk.FindLeftWork();
  EXPECT_TRUE(left.steps.empty());
  ASSERT_EQ(left.left_out.size(), 1u);
  EXPECT_EQ(left.left_out[0],
            "the mask of s1: 3 unsaved steps left out: somebody else has changed it since");
}

TEST_F(MasksInAJournal, StepsThatWereCutShortOrDoNotFitAreLeftOutAndToldOf) {
  const std::vector<uint8_t> painted = PaintAndStop();
  std::ofstream(folder_ / "journal", std::ios::app)
      << "s1\tmask\tnone\t50 30 20 1 0 20\n"  // beyond the right edge
      << "s1\tmask\tnone\t5 5 3 3 0 8\n"      // a pixel too few
      << "s1\tmask\tnone\t5 5 3 3 4 -4 9\n"   // fewer than none
      << "s1\tmask\tnone\t5 5 3 3 4 x\n"      // no number
      << "gone\tmask\tnone\t5 5 3 3 0 9\n"    // no such photograph
      << "s1\tmask\tnone\t0 0 60 40 0 24";    // the machine stopped
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  const LeftMasks left = desk.FindLeftWork();
  EXPECT_THAT(left.left_out,
              testing::UnorderedElementsAre(
                  HasSubstr("gone: 1 unsaved step left out: there is no such photograph"),
                  "the mask of s1: 3 unsaved steps left out: they do not fit the photograph",
                  HasSubstr("the journal: 2 unsaved steps left out: cut short")));
  // What comes after half a line is a line of its own.
  desk.Paint(0).Lasso({{2, 2}, {20, 3}, {9, 30}}, true);
  Session again = Open();
  MaskDesk desk_again(again, folder_.path());
  desk_again.TakeLeftWork(desk_again.FindLeftWork());
  MaskPaint expected({60, 40}, {});
  expected.BeginStroke();
  expected.Brush({30, 20}, {40, 20}, 4, true);
  expected.EndStroke();
  EXPECT_EQ(expected.ignore().values, painted);
  expected.Lasso({{2, 2}, {20, 3}, {9, 30}}, true);
  EXPECT_EQ(desk_again.Paint(0).ignore().values, expected.ignore().values);
}

TEST_F(MasksInAJournal, SavingTheOneKindLeavesTheOtherInTheJournal) {
  const auto change_tag = [](Session& session) {
    PhotographWork work = session.work(0);
    work.tag->position_in_site.x() += 1;
    session.Change(0, work);
  };
  {
    Session session = Open();
    MaskDesk desk(session, folder_.path());
    change_tag(session);
    PaintSome(desk);
    ASSERT_EQ(desk.Save(0).kind, SaveResult::Kind::kSaved);
  }
  {
    Session session = Open();
    MaskDesk desk(session, folder_.path());
    EXPECT_EQ(session.FindLeftWork().size(), 1u);
    EXPECT_TRUE(desk.FindLeftWork().steps.empty());
    session.TakeLeftWork();
    desk.Paint(0).Undo();
    desk.Paint(0).Lasso({{2, 2}, {20, 3}, {9, 30}}, true);
    ASSERT_EQ(session.Save(0).kind, SaveResult::Kind::kSaved);
  }
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  EXPECT_TRUE(session.FindLeftWork().empty());
  EXPECT_EQ(desk.FindLeftWork().steps.size(), 1u);
  // Dropped, it is not offered again.
  desk.DropLeftWork();
  EXPECT_TRUE(desk.FindLeftWork().steps.empty());
  EXPECT_FALSE(fs::exists(folder_ / "journal"));
}

TEST(MaskStep, IsSmallAndComesBack) {
  Image8 before(6000, 4000, 1);
  Image8 after = before;
  EXPECT_FALSE(FindChangedPart(before, after));
  // A stroke from corner to corner: the part is nearly all of the photograph.
  for (int y = 10; y < 3990; ++y) std::fill_n(after.At(y, y), 40, uint8_t{255});
  const auto part = FindChangedPart(before, after);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->x, 10);
  EXPECT_EQ(part->y, 10);
  EXPECT_EQ(part->width, 3980 + 39);
  EXPECT_EQ(part->height, 3980);
  const MaskStep step = MaskStepOf(after, *part);
  const std::string line = FormatMaskStep(step);
  EXPECT_LT(line.size(), 80000u) << "of 24,000,000 pixels";
  EXPECT_EQ(ParseMaskStep(line), step);
  ASSERT_TRUE(Fits(step, {6000, 4000}));
  EXPECT_FALSE(Fits(step, {4000, 4000}));
  PutMaskStep(step, before);
  EXPECT_EQ(before.values, after.values);
  // By hand: a part of 3 x 2 pixels whose first is ignored.
  Image8 small(4, 3, 1);
  *small.At(1, 1) = *small.At(3, 1) = *small.At(1, 2) = 255;
  EXPECT_EQ(FormatMaskStep(MaskStepOf(small, {1, 1, 3, 2})), "1 1 3 2 0 1 1 2 2");
}

}  // namespace
}  // namespace groundglass
