// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

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

TEST(Usage, TheProgramItselfStarts) {
  EXPECT_EQ(std::system(GROUNDGLASS_PROGRAM " --version > /dev/null"), 0);
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

TEST(Usage, EveryHelpEndsWithAnExample) {
  for (const std::vector<std::string>& command : {std::vector<std::string>{"run"},
                                                  {"check"},
                                                  {"calibrate"},
                                                  {"calibrate", "board"},
                                                  {"register"},
                                                  {"invrender"},
                                                  {"render"},
                                                  {"synth"},
                                                  {"evaluate"},
                                                  {"convert"}}) {
    std::vector<std::string> words = command;
    words.push_back("--help");
    const ProgramRun help = RunProgram(words);
    EXPECT_EQ(help.status, 0) << command.back();
    const size_t example = help.out.rfind("Example:\n  groundglass " + command.front());
    ASSERT_NE(example, std::string::npos) << command.back();
    // Nothing after it but the lines to copy.
    const std::string rest = help.out.substr(help.out.find('\n', example) + 1);
    EXPECT_THAT(rest, StartsWith("  groundglass ")) << command.back();
    EXPECT_EQ(rest.find("--help"), std::string::npos) << command.back();
  }
  // No words: the help, which says what there is.
  const ProgramRun nothing = RunProgram({});
  EXPECT_THAT(nothing.out, HasSubstr("Example:"));
  EXPECT_THAT(nothing.out, HasSubstr("invrender"));
}

TEST(Usage, ChoicesAreListedForPeople) {
  const std::string help = RunProgram({"render", "--help"}).out;
  EXPECT_THAT(help, HasSubstr("--mode labels|shaded|textured|wire"));
  EXPECT_EQ(help.find("ENUM"), std::string::npos);
  EXPECT_EQ(RunProgram({"render", "m.osu", "--view", "v", "-o", "o.png", "--mode", "oil"}).status,
            2);
}

TEST(Usage, ModelOptionsAreInEveryCommandThatReadsAModel) {
  for (const char* command :
       {"check", "run", "register", "invrender", "render", "convert", "evaluate"}) {
    const std::string help = RunProgram({command, "--help"}).out;
    for (const char* option : {"--up", "--frame", "--unit", "--sigma-model", "--flip-faces"}) {
      EXPECT_THAT(help, HasSubstr(option)) << command;
    }
    EXPECT_THAT(help, HasSubstr("ft, m, mm, cm, in or us-ft")) << command;
  }
}

TEST(Usage, AMistypedWordIsNamedWithWhatWasMeant) {
  const auto message = [](const std::vector<std::string>& words) {
    const ProgramRun run = RunProgram(words);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, StartsWith("groundglass: "));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_THAT(message({"rn", "scene", "-o", "out"}), HasSubstr("'rn'; did you mean run?"));
  EXPECT_THAT(message({"regster"}), HasSubstr("'regster'; did you mean register?"));
  EXPECT_THAT(message({"paint"}), testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(message({"calibrate", "bord"}), HasSubstr("'bord'; did you mean board?"));
  EXPECT_THAT(message({"run", "scene", "-o", "out", "--stils", "3"}),
              HasSubstr("there is no option --stils; did you mean --stills?"));
  EXPECT_THAT(message({"run", "scene", "-o", "out", "--unit", "furlong"}),
              HasSubstr("ft, m, mm, cm, in or us-ft"));
}

TEST(Usage, ErrorsAreObjectsForThoseWhoAskForJson) {
  const TemporaryFolder work;
  const std::string nowhere = (work / "nowhere").string();
  const std::string out = (work / "out").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", nowhere, "-o", out},
                                                {"register", nowhere, "-o", out},
                                                {"invrender", nowhere, "-o", out},
                                                {"render", nowhere, "--view", nowhere, "-o", out},
                                                {"evaluate", nowhere, "--truth", nowhere},
                                                {"convert", nowhere + ".osu", out + ".obj"},
                                                {"calibrate", "board", nowhere, "-o", out},
                                                {"synth", "no-such-preset", "-o", out}}) {
    std::vector<std::string> with_json = words;
    with_json.push_back("--json");
    const ProgramRun run = RunProgram(with_json);
    const nlohmann::json error = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_TRUE(error.is_object()) << words.front() << ": " << run.out;
    EXPECT_EQ(error["exit"], 1) << words.front();
    EXPECT_EQ("groundglass: " + error["error"].get<std::string>() + "\n", run.err);
  }
  const nlohmann::json usage = nlohmann::json::parse(RunProgram({"rn", "--json"}).out);
  EXPECT_EQ(usage["exit"], 2);
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

// A shell's variable that is not set.
TEST(Usage, AnEmptyWordIsNoNumberAndNoFolder) {
  const ProgramRun run = RunProgram({"register", "scene", "-o", "out", "--sigma-position", ""});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("an empty word on the command line after --sigma-position"));
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
