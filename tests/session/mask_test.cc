// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/ignore_mask.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "session/mask_desk.h"
#include "tests/register/house.h"
#include "tests/support/spoilt_options.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

int CountIgnored(const MaskPaint& paint) {
  const auto& values = paint.ignore().values;
  return static_cast<int>(std::count(values.begin(), values.end(), 255));
}

TEST(MaskPaint, ABrushPaintsADiscAlongItsWayAndErasesIt) {
  MaskPaint paint({60, 40}, {});
  EXPECT_TRUE(paint.IsEmpty());
  paint.BeginStroke();
  paint.Brush({20, 20}, {40, 20}, 5, true);
  paint.EndStroke();
  // A rectangle and two half discs.
  EXPECT_NEAR(CountIgnored(paint), 20 * 10 + M_PI * 25, 12);
  EXPECT_EQ(*paint.ignore().At(30, 24), 255);
  EXPECT_EQ(*paint.ignore().At(30, 25), 0);
  paint.BeginStroke();
  paint.Brush({0, 20}, {60, 20}, 6, false);
  paint.EndStroke();
  EXPECT_TRUE(paint.IsEmpty());
  EXPECT_EQ(paint.UndoDepth(), 2);
  // The smallest brush still paints the pixel under it; beyond the frame nothing happens.
  paint.BeginStroke();
  paint.Brush({7.5, 8.5}, {7.5, 8.5}, 0, true);
  paint.Brush({-90, -90}, {-80, -90}, 4, true);
  paint.EndStroke();
  EXPECT_EQ(CountIgnored(paint), 1);
}

TEST(MaskPaint, UndoAndRedoGoStepByStepToTheByte) {
  Image8 first(60, 40, 1);
  *first.At(3, 3) = 255;
  MaskPaint paint({60, 40}, first);
  paint.BeginStroke();
  for (int x = 10; x < 40; ++x) paint.Brush({x + 0.0, 10}, {x + 1.0, 10}, 3, true);
  paint.EndStroke();
  const Image8 second = paint.ignore();
  paint.Lasso({{5, 5}, {50, 8}, {30, 35}}, false);
  const Image8 third = paint.ignore();
  EXPECT_EQ(paint.UndoDepth(), 2) << "a stroke is one step";
  ASSERT_TRUE(paint.Undo());
  EXPECT_EQ(paint.ignore().values, second.values);
  ASSERT_TRUE(paint.Undo());
  EXPECT_EQ(paint.ignore().values, first.values);
  EXPECT_FALSE(paint.Undo());
  paint.Redo();
  paint.Redo();
  EXPECT_EQ(paint.ignore().values, third.values);
  EXPECT_FALSE(paint.Redo());
  // A stroke that changes nothing is none.
  paint.BeginStroke();
  paint.Brush({1, 30}, {2, 30}, 1, false);
  paint.EndStroke();
  EXPECT_EQ(paint.UndoDepth(), 2);
}

TEST(MaskPaint, ALassoFillsItsInsideByTheEvenOddRule) {
  MaskPaint paint({60, 40}, {});
  paint.Lasso({{10, 10}, {30, 10}, {30, 20}, {10, 20}}, true);
  EXPECT_EQ(CountIgnored(paint), 200);
  paint.Lasso({{-10, -10}, {200, -10}, {200, 200}, {-10, 200}}, true);
  EXPECT_EQ(CountIgnored(paint), 60 * 40) << "what lies outside is left out";
}

TEST(MaskPaint, WhatIsFilledIsOneStep) {
  MaskPaint paint({60, 40}, {});
  Image8 where(60, 40, 1);
  *where.At(7, 8) = 255;
  *where.At(9, 8) = 1;
  paint.Fill(where, true);
  EXPECT_EQ(CountIgnored(paint), 2);
  EXPECT_EQ(paint.UndoDepth(), 1);
  paint.Fill(where, false);
  EXPECT_TRUE(paint.IsEmpty());
  paint.Fill({}, true);
  EXPECT_EQ(paint.UndoDepth(), 2) << "nothing is filled by a place outside of the picture";
}

class MasksOfAScene : public testing::Test {
 protected:
  MasksOfAScene() {
    folder_.Write("model.osu", FormatOsu(MakeHouse()));
    WriteSrgb8(folder_ / "images/s1.png", Image8(60, 40, 3, 90));
    folder_.Write("views/s1.view", "x 62 y 48 z 5 i 20 j -4 k 11 a 1.5 v 54");
  }
  Session Open() const { return Session(ScanScene(folder_.path()).scene, {}); }
  static void PaintSome(MaskDesk& desk) {
    desk.Paint(0).BeginStroke();
    desk.Paint(0).Brush({30, 20}, {40, 20}, 4, true);
    desk.Paint(0).EndStroke();
  }

  TemporaryFolder folder_;
};

TEST_F(MasksOfAScene, AMaskThatIsPaintedIsOneThatTheCommandsRead) {
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  EXPECT_FALSE(session.photographs()[0].mask_file);
  PaintSome(desk);
  EXPECT_TRUE(desk.HasUnsaved());
  ASSERT_EQ(desk.Save(0).kind, SaveResult::Kind::kSaved);
  EXPECT_FALSE(desk.HasUnsaved());
  const Scene scene = ReadScene(folder_.path());
  ASSERT_EQ(scene.photographs[0].mask_file, folder_ / "masks/s1.png");
  EXPECT_EQ(session.photographs()[0].mask_file, scene.photographs[0].mask_file);
  EXPECT_EQ(ReadIgnoreMask(*scene.photographs[0].mask_file, {60, 40}).values,
            desk.Paint(0).ignore().values);
  // Undone to the start there is none again.
  desk.Paint(0).Undo();
  ASSERT_EQ(desk.Save(0).kind, SaveResult::Kind::kSaved);
  EXPECT_FALSE(fs::exists(folder_ / "masks/s1.png"));
}

TEST_F(MasksOfAScene, AMaskOfSomebodyElseComesBackToTheByteAndIsNotWrittenOverUnasked) {
  Image8 theirs(60, 40, 3);
  std::fill_n(theirs.At(5, 5), 3, uint8_t{255});
  WriteSrgb8(folder_ / "masks/s1.png", theirs);
  const std::string bytes = ReadFileBytes(folder_ / "masks/s1.png");
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  PaintSome(desk);
  EXPECT_EQ(*desk.Paint(0).ignore().At(5, 5), 255);
  ASSERT_EQ(desk.Save(0).kind, SaveResult::Kind::kSaved);
  EXPECT_NE(ReadFileBytes(folder_ / "masks/s1.png"), bytes);
  desk.Paint(0).Undo();
  ASSERT_EQ(desk.Save(0).kind, SaveResult::Kind::kSaved);
  EXPECT_EQ(ReadFileBytes(folder_ / "masks/s1.png"), bytes);
  desk.Paint(0).Redo();
  WriteSrgb8(folder_ / "masks/s1.png", Image8(60, 40, 1, 255));
  EXPECT_EQ(desk.Save(0).kind, SaveResult::Kind::kChangedOnDisk);
  EXPECT_EQ(*ReadIgnoreMask(folder_ / "masks/s1.png", {60, 40}).At(0, 0), 255);
  EXPECT_EQ(desk.Save(0, true).kind, SaveResult::Kind::kSaved);
}

TEST_F(MasksOfAScene, AMaskOfAPhotographWithoutATagIsFoundToo) {
  fs::remove(folder_ / "views/s1.view");
  Image8 theirs(60, 40, 3);
  std::fill_n(theirs.At(5, 5), 3, uint8_t{255});
  WriteSrgb8(folder_ / "masks/S1.tif", theirs);
  Session session = Open();
  ASSERT_EQ(session.photographs().size(), 1u);
  MaskDesk desk(session, folder_.path());
  EXPECT_EQ(*desk.Paint(0).ignore().At(5, 5), 255);
  PaintSome(desk);
  EXPECT_THAT(desk.Save(0).message, HasSubstr("which is no .png"));
  EXPECT_FALSE(fs::exists(folder_ / "masks/s1.png")) << "two masks for one photograph";
}

TEST_F(MasksOfAScene, WhatCannotBeWrittenIsToldAndKept) {
  Session session = Open();
  MaskDesk desk(session, folder_.path());
  folder_.Write("masks", "a file where a folder should be");
  PaintSome(desk);
  const SaveResult result = desk.Save(0);
  EXPECT_EQ(result.kind, SaveResult::Kind::kFailed);
  EXPECT_THAT(result.message, HasSubstr("not saved"));
  EXPECT_TRUE(desk.HasUnsaved());
}

TEST(MaskPaintOptions, AreChecked) {
  ExpectCheckNamesEach<MaskPaintOptions>(
      {{"max_history_bytes", [](MaskPaintOptions& o) { o.max_history_bytes = 0; }}});
}

}  // namespace
}  // namespace groundglass
