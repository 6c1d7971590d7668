// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/session.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "session/frame_governor.h"
#include "session/pins_file.h"
#include "tests/register/house.h"
#include "tests/support/as_nobody.h"
#include "tests/support/spoilt_options.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kView =
    "% hall\n x 62 % paced\n\ty 48\nz 5 i 20 j -4 k 11\na 1.5\nv 54%50 mm";

// s1 has a tag, s2 none.
void MakeSceneFolder(const TemporaryFolder& folder) {
  folder.Write("model.osu", FormatOsu(MakeHouse()));
  for (const char* name : {"s1", "s2"}) {
    WriteSrgb8(folder / ("images/" + std::string(name) + ".png"), Image8(60, 40, 3, 90));
  }
  folder.Write("views/s1.view", kView);
}

Pins FivePins() {
  ViewTag truth;
  truth.position_in_site = {64, 50, 5};
  truth.lookat_in_site = {20, -4, 11};
  truth.view_angle_deg = 52;
  const Camera camera = CameraFromTag(truth, 60, 40);
  Pins pins;
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0, 0, 0),
                                       Eigen::Vector3d(40, 0, 16),
                                       Eigen::Vector3d(40, 10, 24),
                                       Eigen::Vector3d(40, 20, 0),
                                       Eigen::Vector3d(0, 0, 16)}) {
    pins.points.push_back({point, *Project(camera, point), 0.5, PinUse::kUsed});
  }
  return pins;
}

std::string Bytes(const fs::path& file) { return ReadTextFile(file); }

PhotographWork With(const Session& session, int photograph, const Pins& pins) {
  PhotographWork work = session.work(photograph);
  work.pins = pins;
  return work;
}

class SessionOnAScene : public testing::Test {
 protected:
  SessionOnAScene() { MakeSceneFolder(folder_); }
  Session Open() const { return Session(ScanScene(folder_.path()).scene, folder_ / "journal"); }

  TemporaryFolder folder_;
};

TEST_F(SessionOnAScene, UndoToTheStartGivesTheFirstBytesBack) {
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  session.Change(s1, With(session, s1, FivePins()));
  ASSERT_EQ(session.Save(s1).kind, SaveResult::Kind::kSaved);
  EXPECT_NE(Bytes(folder_ / "views/s1.view"), kView);
  EXPECT_THAT(Bytes(folder_ / "views/s1.view"), HasSubstr("% paced (measured 62, now +-"));
  EXPECT_TRUE(fs::exists(folder_ / "pins.points"));
  EXPECT_FALSE(session.IsUnsaved(s1));
  ASSERT_TRUE(session.Undo(s1));
  EXPECT_TRUE(session.IsUnsaved(s1)) << "undo after saving is unsaved again";
  ASSERT_EQ(session.Save(s1).kind, SaveResult::Kind::kSaved);
  EXPECT_EQ(Bytes(folder_ / "views/s1.view"), kView);
  EXPECT_FALSE(fs::exists(folder_ / "pins.points"));
  ASSERT_TRUE(session.Redo(s1));
  EXPECT_EQ(session.work(s1).pins, FivePins());
  EXPECT_FALSE(session.Redo(s1));
}

TEST_F(SessionOnAScene, APhotographWithoutATagGetsOneThatTheCommandsRead) {
  Session session = Open();
  const int s2 = *session.FindPhotograph("s2");
  EXPECT_FALSE(session.CameraOf(s2));
  PhotographWork work = session.work(s2);
  work.tag = RoughTag({70, -55, 6}, {14, 2, 8}, 60, 40, false);
  work.pins = FivePins();
  session.Change(s2, work);
  ASSERT_EQ(session.Save(s2).kind, SaveResult::Kind::kSaved);
  const Scene scene = ReadScene(folder_.path());
  ASSERT_EQ(scene.photographs.size(), 2u);
  EXPECT_EQ(scene.photographs[1].tag, *session.TagOf(s2));
  EXPECT_TRUE(scene.photographs[1].tag.sigmas.position);
  session.Undo(s2);
  ASSERT_EQ(session.Save(s2).kind, SaveResult::Kind::kSaved);
  EXPECT_FALSE(fs::exists(folder_ / "views/s2.view"));
}

TEST_F(SessionOnAScene, PinsThatWereSavedAreThereAgainAndSolveToTheSameCamera) {
  Eigen::Vector3d before;
  {
    Session session = Open();
    const int s1 = *session.FindPhotograph("s1");
    session.Change(s1, With(session, s1, FivePins()));
    before = session.CameraOf(s1)->PositionInWorld();
    session.Save(s1);
  }
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  EXPECT_EQ(session.work(s1).pins, FivePins());
  EXPECT_FALSE(session.IsUnsaved(s1));
  EXPECT_LT((session.CameraOf(s1)->PositionInWorld() - before).norm(), 0.2);
}

TEST_F(SessionOnAScene, SavingWhatAlignmentSaidChangesNoFile) {
  {
    Session session = Open();
    const int s1 = *session.FindPhotograph("s1");
    session.Change(s1, With(session, s1, FivePins()));
    ASSERT_EQ(session.Save(s1).kind, SaveResult::Kind::kSaved);
  }
  const std::string view = Bytes(folder_ / "views/s1.view");
  const std::string pins = Bytes(folder_ / "pins.points");
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  PhotographWork work = session.work(s1);
  work.alignment.emplace();
  session.Change(s1, work);
  ASSERT_EQ(session.Save(s1).kind, SaveResult::Kind::kSaved);
  EXPECT_EQ(Bytes(folder_ / "views/s1.view"), view) << "sigmas that were widened to reopen it";
  EXPECT_EQ(Bytes(folder_ / "pins.points"), pins);
}

TEST_F(SessionOnAScene, KeepingMineKeepsOthersPinsOfOtherPhotographs) {
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  session.Change(s1, With(session, s1, FivePins()));
  const std::string others = ReplacePins("", "s2", FivePins());
  folder_.Write("pins.points", others);
  ASSERT_EQ(session.Save(s1).kind, SaveResult::Kind::kChangedOnDisk);
  ASSERT_EQ(session.Save(s1, true).kind, SaveResult::Kind::kSaved);
  const std::string kept = Bytes(folder_ / "pins.points");
  EXPECT_EQ(kept.substr(0, others.size()), others);
  EXPECT_EQ(ParsePins(kept, "pins.points").at("s1"), FivePins());
  // Back to none of one's own: theirs are still there.
  ASSERT_TRUE(session.Undo(s1));
  ASSERT_EQ(session.Save(s1).kind, SaveResult::Kind::kSaved);
  EXPECT_EQ(Bytes(folder_ / "pins.points"), others);
}

TEST_F(SessionOnAScene, PinsOfANameWithABlankAreRefusedInWords) {
  fs::rename(folder_ / "images/s1.png", folder_ / "images/s 1.png");
  fs::rename(folder_ / "views/s1.view", folder_ / "views/s 1.view");
  Session session = Open();
  const int photograph = *session.FindPhotograph("s 1");
  session.Change(photograph, With(session, photograph, FivePins()));
  const SaveResult refused = session.Save(photograph);
  EXPECT_EQ(refused.kind, SaveResult::Kind::kFailed);
  EXPECT_THAT(refused.message, HasSubstr("'s 1' holds a blank"));
  EXPECT_FALSE(fs::exists(folder_ / "pins.points"));
}

TEST_F(SessionOnAScene, StepsOfOneGestureAreOneStepBack) {
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  Pins pins = FivePins();
  session.Change(s1, With(session, s1, pins));
  for (int i = 0; i < 20; ++i) {
    pins.points[0].image_px.x() += 0.1;
    session.Change(s1, With(session, s1, pins), "drag 0");
  }
  session.EndGesture();
  EXPECT_EQ(session.UndoDepth(s1), 2);
  session.Undo(s1);
  EXPECT_EQ(session.work(s1).pins, FivePins());
}

TEST_F(SessionOnAScene, EachPhotographHasAHistoryOfItsOwn) {
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  const int s2 = *session.FindPhotograph("s2");
  session.Change(s1, With(session, s1, FivePins()));
  EXPECT_FALSE(session.Undo(s2));
  EXPECT_EQ(session.UndoDepth(s1), 1);
}

TEST_F(SessionOnAScene, WhatSomebodyElseHasWrittenIsNotWrittenOver) {
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  session.Change(s1, With(session, s1, FivePins()));
  folder_.Write("views/s1.view", "x 1 y 2 z 3 i 4 j 5 k 6 a 1.5 v 50");
  const SaveResult refused = session.Save(s1);
  EXPECT_EQ(refused.kind, SaveResult::Kind::kChangedOnDisk);
  EXPECT_THAT(refused.message, HasSubstr("s1.view"));
  EXPECT_THAT(Bytes(folder_ / "views/s1.view"), HasSubstr("x 1 y 2"));
  EXPECT_EQ(session.Save(s1, true).kind, SaveResult::Kind::kSaved);
}

TEST_F(SessionOnAScene, AFolderThatCannotBeWrittenToIsToldAndNothingIsLost) {
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  session.Change(s1, With(session, s1, FivePins()));
  const std::string before = Bytes(folder_ / "views/s1.view");
  chmod(folder_.path().c_str(), 0755);
  chmod((folder_ / "views").c_str(), 0555);
  SaveResult result;
  {
    const AsNobody nobody;
    result = session.Save(s1);
  }
  chmod((folder_ / "views").c_str(), 0755);
  EXPECT_EQ(result.kind, SaveResult::Kind::kFailed);
  EXPECT_THAT(result.message, HasSubstr("s1.view"));
  EXPECT_TRUE(session.IsUnsaved(s1));
  EXPECT_EQ(Bytes(folder_ / "views/s1.view"), before);
  EXPECT_EQ(session.Save(s1).kind, SaveResult::Kind::kSaved) << "once it can be written to again";
}

TEST_F(SessionOnAScene, AFolderWhosePlaceIsTakenByAFileIsToldToo) {
  Session session = Open();
  const int s2 = *session.FindPhotograph("s2");
  PhotographWork work = session.work(s2);
  work.tag = RoughTag({70, -55, 6}, {14, 2, 8}, 60, 40, false);
  session.Change(s2, work);
  fs::remove_all(folder_ / "views");
  folder_.Write("views", "a file");
  EXPECT_EQ(session.Save(s2).kind, SaveResult::Kind::kFailed);
  EXPECT_TRUE(session.IsUnsaved(s2));
}

TEST_F(SessionOnAScene, WorkOutlivesASessionThatJustStops) {
  {
    Session session = Open();
    const int s1 = *session.FindPhotograph("s1");
    session.Change(s1, With(session, s1, FivePins()));
  }
  // A step that was being written when the machine stopped.
  std::ofstream(folder_ / "journal", std::ios::app) << "s1\t{\"tag\": nul";
  Session session = Open();
  const int s1 = *session.FindPhotograph("s1");
  ASSERT_EQ(session.FindLeftWork().size(), 1u);
  session.TakeLeftWork();
  EXPECT_EQ(session.work(s1).pins, FivePins());
  EXPECT_EQ(session.UndoDepth(s1), 1);
  session.Save(s1);
  EXPECT_TRUE(Open().FindLeftWork().empty());
}

TEST_F(SessionOnAScene, WorkThatWasUndoneIsNotOfferedAgain) {
  {
    Session session = Open();
    const int s1 = *session.FindPhotograph("s1");
    session.Change(s1, With(session, s1, FivePins()));
    session.Undo(s1);
  }
  EXPECT_TRUE(Open().FindLeftWork().empty());
}

TEST(PhotographWork, ComesBackToTheLastBit) {
  PhotographWork work;
  work.tag = RoughTag({70.1, -55, 1.0 / 3}, {14, 2, 8}, 60, 40, true);
  work.pins = FivePins();
  work.pins.lines.push_back({{0, 1, 2}, {3, 4, 5}, {6, 7}, {8, 9}, 1.5, PinUse::kCheck});
  work.alignment = AlignmentNews{
      Verdict::kReview, {"a \"reason\""}, *work.tag, 12.5, 0.4, 0.6, std::nullopt, {"k1"}};
  work.accepted = work.tag;
  work.overruled = "seen on the slide";
  EXPECT_EQ(ParseWork(FormatWork(work)), work);
}

TEST(FrameGovernor, QualityGivesWayAndComesBack) {
  FrameGovernor governor;
  EXPECT_EQ(governor.QualityAt(0), FrameQuality::kAtRest);
  governor.Moved(0);
  EXPECT_EQ(governor.QualityAt(50), FrameQuality::kPlain);
  for (int i = 0; i < 3; ++i) governor.Drew(FrameQuality::kPlain, 45);
  EXPECT_EQ(governor.QualityAt(60), FrameQuality::kTwoThirds);
  governor.Drew(FrameQuality::kTwoThirds, 80);
  EXPECT_EQ(governor.QualityAt(60), FrameQuality::kHalf);
  for (int i = 0; i < 25; ++i) governor.Drew(governor.QualityAt(60), 10);
  EXPECT_EQ(governor.QualityAt(60), FrameQuality::kPlain);
  EXPECT_EQ(governor.QualityAt(130), FrameQuality::kAtRest);
}

TEST(SessionOptions, AreChecked) {
  ExpectCheckNamesEach<SessionOptions>(
      {{"max_iterations", [](SessionOptions& o) { o.solver.max_iterations = 0; }},
       {"free_share", [](SessionOptions& o) { o.solver.free_share = 2; }},
       {"aim_yaw_deg", [](SessionOptions& o) { o.solver.aim_yaw_deg = 0; }},
       {"aim_pitch_deg", [](SessionOptions& o) { o.solver.aim_pitch_deg = -1; }},
       {"aim_roll_deg", [](SessionOptions& o) { o.solver.aim_roll_deg = 0; }},
       {"least_variance_share", [](SessionOptions& o) { o.solver.least_variance_share = 0; }},
       {"cropped_from", [](SessionOptions& o) { o.rough.cropped_from = 0; }},
       {"roll_deg", [](SessionOptions& o) { o.rough.roll_deg = 0; }},
       {"max_undo_steps", [](SessionOptions& o) { o.max_undo_steps = 0; }},
       {"pin_sigma_px", [](SessionOptions& o) { o.pin_sigma_px = 0; }},
       {"reopened_widening", [](SessionOptions& o) { o.reopened_widening = 0.5; }}});
  ExpectCheckNamesEach<FrameGovernorOptions>(
      {{"too_slow_ms", [](FrameGovernorOptions& o) { o.too_slow_ms = 0; }},
       {"fast_ms", [](FrameGovernorOptions& o) { o.fast_ms = 99; }},
       {"fast_frames", [](FrameGovernorOptions& o) { o.fast_frames = 0; }},
       {"rest_ms", [](FrameGovernorOptions& o) { o.rest_ms = 0; }},
       {"smoothing", [](FrameGovernorOptions& o) { o.smoothing = 2; }}});
}

}  // namespace
}  // namespace groundglass
