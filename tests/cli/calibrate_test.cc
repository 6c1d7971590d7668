// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// The tag without its view angle.
void LeaveOutViewAngle(const fs::path& view) {
  std::string text = ReadAll(view);
  const size_t at = text.find("\nv ");
  ASSERT_NE(at, std::string::npos);
  text.erase(at, text.find('\n', at + 1) - at);
  WriteAll(view, text);
}

TEST(Calibrate, LinesTellTheViewAngleThatATagLacksAndItsOwnNumberWins) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s3", "s6"});
  const std::string scene = (work / "scene").string();
  LeaveOutViewAngle(work / "scene/views/s3.view");
  const ProgramRun before = RunProgram({"check", scene});
  EXPECT_EQ(before.status, 1);
  EXPECT_THAT(before.out, HasSubstr("'v' is missing, and the picture's metadata say no focal"));

  const ProgramRun lens = RunProgram({"calibrate", "lens", scene});
  EXPECT_EQ(lens.status, 0) << lens.err;
  EXPECT_THAT(lens.out, HasSubstr("s3: the picture's metadata say no focal length\n"));
  EXPECT_FALSE(fs::exists(work / "scene/calibration"));

  const ProgramRun lines = RunProgram({"calibrate", "lines", scene});
  EXPECT_EQ(lines.status, 0) << lines.err;
  EXPECT_THAT(lines.out, HasSubstr("s3: v 5"));
  const ProgramRun after = RunProgram({"check", scene});
  EXPECT_EQ(after.status, 0) << after.out;
  EXPECT_THAT(after.out, HasSubstr("note: s3: "));
  EXPECT_THAT(after.out, HasSubstr("v roll"));
  // The other tag's v stays what was written, and lacks a roll.
  EXPECT_THAT(ReadAll(work / "scene/calibration/s6.view"), HasSubstr("\nv 5"));
  EXPECT_THAT(after.out, Not(HasSubstr("s6: v")));
}

TEST(Calibrate, OneDamagedFileDoesNotCostTheOthers) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s3", "s6"});
  const std::string damaged = "v fifty % calibrate lines\n";
  fs::create_directories(work / "scene/calibration");
  WriteAll(work / "scene/calibration/s3.view", damaged);
  const ProgramRun lines = RunProgram({"calibrate", "lines", (work / "scene").string()});
  EXPECT_THAT(lines.out, HasSubstr("s3.view:1: key 'v': 'fifty' is not a number"));
  EXPECT_THAT(lines.out, HasSubstr("s6: v 5"));
  EXPECT_EQ(ReadAll(work / "scene/calibration/s3.view"), damaged);
  EXPECT_THAT(ReadAll(work / "scene/calibration/s6.view"), HasSubstr("\nv 5"));
}

TEST(Calibrate, WhatCannotBeReadIsNoSuccess) {
  const TemporaryFolder work;
  const std::string missing = (work / "none.jpg").string();
  const std::string text = work.Write("text.jpg", "no picture").string();
  const std::string good =
      std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/images/s3.jpg";
  for (const char* what : {"lens", "lines", "frame"}) {
    EXPECT_EQ(RunProgram({"calibrate", what, missing}).status, 1) << what;
    EXPECT_EQ(RunProgram({"calibrate", what, text}).status, 1) << what;
  }
  const ProgramRun some = RunProgram({"calibrate", "lens", text, good});
  EXPECT_EQ(some.status, 3);
  EXPECT_THAT(some.out, HasSubstr("s3: the picture's metadata say no focal length"));
}

TEST(Calibrate, ALensOfAnotherShapeThanThePictureIsNotExported) {
  const TemporaryFolder work;
  const std::string lens = work.Write("my.lens", "v 57.3\na 1.5\n").string();
  const ProgramRun turned = RunProgram({"calibrate",
                                        "export",
                                        lens,
                                        "-o",
                                        (work / "ros.yaml").string(),
                                        "--format",
                                        "ros",
                                        "--size",
                                        "1000x1500"});
  EXPECT_EQ(turned.status, 1);
  EXPECT_THAT(turned.err, HasSubstr("is it 1500x1000?"));
  EXPECT_FALSE(fs::exists(work / "ros.yaml"));
}

TEST(Calibrate, ALensFileGoesToRosAndComesBack) {
  const TemporaryFolder work;
  const std::string lens = work.Write("my.lens", "v 57.3\na 1.5\nshift_x 0.01\nk1 -0.1\n").string();
  const std::string ros = (work / "ros.yaml").string();
  const std::string back = (work / "back.lens").string();
  EXPECT_EQ(RunProgram({"calibrate", "export", lens, "-o", ros, "--format", "ros"}).status, 2);
  ASSERT_EQ(
      RunProgram({"calibrate", "export", lens, "-o", ros, "--format", "ros", "--size", "1500x1000"})
          .status,
      0);
  EXPECT_THAT(ReadAll(ros), HasSubstr("distortion_model: plumb_bob"));
  ASSERT_EQ(RunProgram({"calibrate", "export", ros, "-o", back}).status, 0);
  EXPECT_THAT(ReadAll(back), HasSubstr("v 57.3"));
  EXPECT_THAT(ReadAll(back), HasSubstr("k1 -0.1\n"));
}

// A slide of 3:2 squeezed into 640 x 480, which no file's size tells from a camera's 4:3.
TEST(Calibrate, ATelevisionFrameMayHoldASlideOrACamerasView) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s3"});
  const fs::path picture = work / "scene/images/s3.png";
  WriteSrgb8(picture, Image8(640, 480, 3, 128));
  fs::remove(work / "scene/images/s3.jpg");
  std::string tag = ReadAll(work / "scene/views/s3.view");
  tag.erase(tag.find("\na "), tag.find('\n', tag.find("\na ") + 1) - tag.find("\na "));
  WriteAll(work / "scene/views/s3.view", tag);
  const std::string scene = (work / "scene").string();
  const ProgramRun frame = RunProgram({"calibrate", "frame", scene});
  EXPECT_EQ(frame.status, 0) << frame.err;
  EXPECT_THAT(frame.out, HasSubstr("s3: a 1.4167 +- 0.083"));
  // Lines take no pixels' shape for granted that is open, with or without the folder.
  for (const std::string& input : {scene, picture.string()}) {
    EXPECT_THAT(RunProgram({"calibrate", "lines", input}).out,
                HasSubstr("the shape of its pixels is not known (width / height 1.33 to 1.50)"));
  }
  EXPECT_THAT(RunProgram({"calibrate", "frame", scene, "--aspect", "1.5"}).out,
              HasSubstr("s3: a 1.5 +- 0.0075"));
}

TEST(Calibrate, AMissingSurveyAndAFolderWithoutScansSayWhatIsExpected) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s3"});
  const ProgramRun tags = RunProgram({"calibrate", "tags", (work / "scene").string()});
  EXPECT_EQ(tags.status, 1);
  EXPECT_THAT(tags.err, HasSubstr("apriltags.csv: no such file: the tags' survey is needed"));
  fs::create_directories(work / "empty");
  const ProgramRun empty = RunProgram({"calibrate", "frame", (work / "empty").string()});
  EXPECT_EQ(empty.status, 1);
  EXPECT_THAT(empty.err, HasSubstr("empty: no scans; expected scans/ with pictures in it"));
  // A folder of pictures, no scene.
  const ProgramRun folder = RunProgram({"calibrate", "frame", (work / "scene/images").string()});
  EXPECT_EQ(folder.status, 0) << folder.err;
  EXPECT_THAT(folder.out, HasSubstr("s3: nothing, since"));
  // Heights from a grid that is not there.
  const ProgramRun geoid =
      RunProgram({"calibrate", "lens", (work / "scene").string(), "--geoid", "egm96-5"});
  EXPECT_EQ(geoid.status, 1);
  EXPECT_THAT(geoid.err, HasSubstr("--geoid egm96-5: the model does not say where it stands"));
}

}  // namespace
}  // namespace groundglass
