// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "session/alignment.h"
#include "session/session.h"
#include "tests/register/house.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kWritten = "x 62 % paced\r\ny 48 z 5 i 20 j -4 k 11 a 1.5 v 54";

// What a run made of s1: half a foot to the east.
AlignmentNews FoundByARun(const Session& session, Verdict verdict) {
  AlignmentNews news;
  news.verdict = verdict;
  news.reasons = {"the rival fits as well"};
  news.corrected = *session.work(0).tag;
  news.corrected.position_in_site.x() += 0.5;
  news.corrected.sigmas.position = 0.02;
  return news;
}

class SessionAfterARun : public testing::Test {
 protected:
  SessionAfterARun() {
    folder_.Write("model.osu", FormatOsu(MakeHouse()));
    WriteSrgb8(folder_ / "images/s1.png", Image8(60, 40, 3, 90));
    folder_.Write("views/s1.view", kWritten);
  }
  Session Open() const { return Session(ScanScene(folder_.path()).scene, folder_ / "journal"); }
  std::string View() const { return ReadTextFile(folder_ / "views/s1.view"); }

  TemporaryFolder folder_;
};

TEST_F(SessionAfterARun, WorkStartsFromWhatWasFoundAndNothingIsUnsaved) {
  Session session = Open();
  const AlignmentNews found = FoundByARun(session, Verdict::kAccepted);
  session.StartFrom(0, found);
  EXPECT_TRUE(session.IsAsFound(0));
  EXPECT_FALSE(session.HasUnsaved());
  EXPECT_DOUBLE_EQ(session.CameraOf(0)->PositionInWorld().x(), 62.5);
  EXPECT_FALSE(fs::exists(folder_ / "journal")) << "nobody has done anything yet";
  // Pins start from there as unsure as the notebook is.
  EXPECT_EQ(session.work(0).tag->position_in_site, found.corrected.position_in_site);
  EXPECT_FALSE(session.work(0).tag->sigmas.position);
}

TEST_F(SessionAfterARun, UndoAndTheNotebookGiveTheWrittenTagBack) {
  Session session = Open();
  const PhotographWork written = session.work(0);
  session.StartFrom(0, FoundByARun(session, Verdict::kReview));
  ASSERT_TRUE(session.Undo(0));
  EXPECT_EQ(session.work(0), written);
  EXPECT_FALSE(session.IsUnsaved(0));
  ASSERT_TRUE(session.Redo(0));
  EXPECT_TRUE(session.IsAsFound(0));
  session.BackToNotebook(0);
  EXPECT_EQ(session.work(0), written);
  EXPECT_EQ(session.Save(0).kind, SaveResult::Kind::kNothingToSave);
  EXPECT_EQ(View(), kWritten);
}

TEST_F(SessionAfterARun, AnAcceptedCameraIsSavedWhenAskedForAndOneInReviewIsNot) {
  {
    Session session = Open();
    session.StartFrom(0, FoundByARun(session, Verdict::kReview));
    EXPECT_THAT(session.Save(0).message, HasSubstr("nobody has taken"));
    EXPECT_EQ(View(), kWritten);
  }
  Session session = Open();
  session.StartFrom(0, FoundByARun(session, Verdict::kAccepted));
  ASSERT_EQ(session.Save(0).kind, SaveResult::Kind::kSaved);
  EXPECT_THAT(View(), HasSubstr("x 62.5 % paced (measured 62, now +-0.02)"));
  // What is on the disk now is another tag than the notebook's.
  session.Undo(0);
  EXPECT_TRUE(session.IsUnsaved(0));
  ASSERT_EQ(session.Save(0).kind, SaveResult::Kind::kSaved);
  EXPECT_EQ(View(), kWritten);
}

TEST_F(SessionAfterARun, TheReasonOfAnOverruleIsInTheViewFileAndComesBack) {
  {
    Session session = Open();
    session.StartFrom(0, FoundByARun(session, Verdict::kReview));
    PhotographWork work = session.work(0);
    work.accepted = work.alignment->corrected;
    work.overruled = "the chimney is right,\nseen on the slide";
    session.Change(0, work);
    ASSERT_EQ(session.Save(0).kind, SaveResult::Kind::kSaved);
  }
  EXPECT_THAT(View(),
              HasSubstr("\r\n% taken against the verdict: the chimney is right, seen on the "
                        "slide\r\n"));
  EXPECT_DOUBLE_EQ(ReadView(folder_ / "views/s1.view").position_in_site.x(), 62.5);
  Session session = Open();
  EXPECT_EQ(session.work(0).overruled, "the chimney is right, seen on the slide");
  const std::string before = View();
  // Another reason takes its place, none takes it away, and undo gives it back.
  PhotographWork work = session.work(0);
  work.accepted = work.tag;
  work.overruled = "measured again";
  session.Change(0, work);
  session.Save(0);
  EXPECT_THAT(View(), HasSubstr("% taken against the verdict: measured again\r\n"));
  EXPECT_THAT(View(), Not(HasSubstr("chimney")));
  work.overruled.clear();
  session.Change(0, work);
  session.Save(0);
  EXPECT_THAT(View(), Not(HasSubstr("verdict")));
  session.Undo(0);
  session.Undo(0);
  session.Save(0);
  EXPECT_EQ(View(), before);
}

TEST_F(SessionAfterARun, AnAlignmentThatIsStoppedGivesNothing) {
  const Session session = Open();
  const std::atomic<bool> stop = true;
  const SessionPhotograph& s1 = session.photographs()[0];
  EXPECT_FALSE(AlignFromHere(s1, *session.work(0).tag, {}, session.model(), stop));
  AlignmentJob job;
  job.Start(s1, *session.work(0).tag, {}, session.model(), {});
  EXPECT_TRUE(job.IsRunning());
  job.Stop();
  EXPECT_FALSE(job.IsRunning());
  EXPECT_FALSE(job.Take());
}

TEST_F(SessionAfterARun, AnAlignmentSaysWhatCannotBeRead) {
  const Session session = Open();
  fs::remove(folder_ / "images/s1.png");
  const std::atomic<bool> stop = false;
  EXPECT_THROW(
      AlignFromHere(session.photographs()[0], *session.work(0).tag, {}, session.model(), stop),
      std::exception);
}

}  // namespace
}  // namespace groundglass
