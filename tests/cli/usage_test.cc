// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace groundglass {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Wrong input ends with status 1 and one line that begins with the program's name.
void ExpectOneLineError(const ProgramRun& run, const std::string& part) {
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, StartsWith("groundglass: "));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr(part));
}

TEST(Usage, HelpAndVersionAreNoErrors) {
  const ProgramRun help = RunProgram({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"run",
                              "check",
                              "calibrate",
                              "register",
                              "invrender",
                              "render",
                              "synth",
                              "evaluate",
                              "convert"}) {
    EXPECT_THAT(help.out, HasSubstr(command));
    const ProgramRun command_help = RunProgram({command, "--help"});
    EXPECT_EQ(command_help.status, 0) << command;
    EXPECT_FALSE(command_help.out.empty()) << command;
  }
  const ProgramRun version = RunProgram({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, StartsWith("groundglass 0."));
}

TEST(Usage, WrongUsageEndsWithTwo) {
  EXPECT_EQ(RunProgram({}).status, 2);
  EXPECT_EQ(RunProgram({"paint"}).status, 2);
  EXPECT_EQ(RunProgram({"run"}).status, 2);
  EXPECT_EQ(RunProgram({"run", "scene", "-o", "out", "--no-such-flag"}).status, 2);
  EXPECT_EQ(RunProgram({"render", "model.osu", "-o", "a.png"}).status, 2);
  EXPECT_EQ(RunProgram({"calibrate", "board"}).status, 2);
  EXPECT_EQ(RunProgram({"register", "scene", "-o", "out", "--unit", "furlong"}).status, 2);
}

TEST(Usage, MissingInputIsOneLineAndOne) {
  const TemporaryFolder work;
  const std::string nowhere = (work / "nowhere").string();
  const std::string out = (work / "out").string();
  ExpectOneLineError(RunProgram({"run", nowhere, "-o", out, "--quiet"}), nowhere);
  ExpectOneLineError(RunProgram({"register", nowhere, "-o", out, "--quiet"}), nowhere);
  ExpectOneLineError(RunProgram({"render", nowhere, "--view", nowhere, "-o", out + ".png"}),
                     nowhere);
  ExpectOneLineError(RunProgram({"evaluate", nowhere, "--truth", nowhere}), nowhere);
  ExpectOneLineError(RunProgram({"calibrate", "board", nowhere, "-o", out, "--quiet"}), nowhere);
  ExpectOneLineError(RunProgram({"convert", nowhere + ".osu", out + ".obj"}), nowhere);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Calibrate, DrawsABoardAndRefusesPicturesWithoutOne) {
  const TemporaryFolder work;
  const std::string board = (work / "board.png").string();
  const ProgramRun print = RunProgram({"calibrate", "board", "--print", board});
  EXPECT_EQ(print.status, 0) << print.err;
  EXPECT_GT(std::filesystem::file_size(board), 1000u);

  const std::string image =
      std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/images/s1.jpg";
  const std::string lens = (work / "a.lens").string();
  ExpectOneLineError(RunProgram({"calibrate", "board", image, image, image, "-o", lens, "--quiet"}),
                     "0 of 3 photographs show the board");
  EXPECT_FALSE(std::filesystem::exists(lens));
}

}  // namespace
}  // namespace groundglass
