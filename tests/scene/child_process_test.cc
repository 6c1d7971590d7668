// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/child_process.h"

#include "scene/error.h"
#include "tests/support/temporary_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

namespace groundglass {
namespace {

std::string MessageOf(const std::vector<std::string>& command, const ProgramOptions& options = {}) {
  try {
    RunProgram(command, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

ProgramResult RunScript(const std::string& script, std::string_view input = {}) {
  return RunProgram({"sh", "-c", script}, {}, input);
}

void ExpectNoChildIsLeft() {
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(ChildProcess, TellsWhatTheProgramSaidAndReturned) {
  const ProgramResult result = RunScript("echo good; echo bad >&2; exit 3");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.output, "good\n");
  EXPECT_EQ(result.errors, "bad\n");
  ExpectNoChildIsLeft();
}

TEST(ChildProcess, AProgramThatIsMissingIsNamedWithItsPackage) {
  EXPECT_EQ(MessageOf({"no-such-program"}), "the program no-such-program was not found");
  ProgramOptions options;
  options.package = "colmap";
  EXPECT_EQ(MessageOf({"/no/such/program", "x"}, options),
            "the program /no/such/program was not found; install it (Debian: apt-get install "
            "colmap)");
  ExpectNoChildIsLeft();
}

TEST(ChildProcess, AFileThatIsNoProgramIsNamedWithTheReason) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("letter.txt", "Dear Sir").string();
  EXPECT_EQ(MessageOf({file}), "cannot start " + file + ": Permission denied");
  EXPECT_EQ(MessageOf({}), "no program was named to start");
  EXPECT_EQ(MessageOf({""}), "no program was named to start");
}

TEST(ChildProcess, AProgramThatReturns127IsNotTakenForAMissingOne) {
  EXPECT_EQ(RunScript("exit 127").exit_code, 127);
}

TEST(ChildProcess, ASignalsNumberIsAddedTo128) {
  EXPECT_EQ(RunScript("kill -9 $$").exit_code, 128 + 9);
}

TEST(ChildProcess, NoShellReadsTheArguments) {
  const std::string argument = "$HOME; `id` \"a b\" *";
  EXPECT_EQ(RunProgram({"printf", "%s", argument}).output, argument);
}

TEST(ChildProcess, MuchOutputOnBothStreamsAndMuchInputBlockNobody) {
  const std::string input(3000000, 'x');
  const ProgramResult result = RunScript(
      "head -c 5000000 /dev/zero; head -c 4000000 /dev/zero >&2; wc -c; "
      "head -c 5000000 /dev/zero",
      input);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors.size(), 4000000);
  ASSERT_GT(result.output.size(), 10000000);
  EXPECT_EQ(result.output.substr(5000000, 8), "3000000\n");
  EXPECT_EQ(result.output.size(), 10000008);
}

TEST(ChildProcess, InputThatNobodyReadsIsNoSignalToUs) {
  const ProgramResult result = RunProgram({"true"}, {}, std::string(5000000, 'x'));
  EXPECT_EQ(result.exit_code, 0);
}

TEST(ChildProcess, WithoutInputTheProgramReadsAnEmptyOne) {
  EXPECT_EQ(RunScript("wc -c").output, "0\n");
}

TEST(ChildProcess, VariablesAreAddedToTheEnvironmentOrReplaceIt) {
  setenv("GROUNDGLASS_TEST_KEPT", "kept", 1);
  setenv("GROUNDGLASS_TEST_OLD", "old", 1);
  ProgramOptions options;
  options.environment = {{"GROUNDGLASS_TEST_OLD", "a=b c"}, {"GROUNDGLASS_TEST_NEW", ""}};
  const ProgramResult result = RunProgram({"env"}, options);
  EXPECT_THAT(result.output, testing::HasSubstr("GROUNDGLASS_TEST_KEPT=kept\n"));
  EXPECT_THAT(result.output, testing::HasSubstr("GROUNDGLASS_TEST_OLD=a=b c\n"));
  EXPECT_THAT(result.output, testing::HasSubstr("GROUNDGLASS_TEST_NEW=\n"));
  EXPECT_THAT(result.output, testing::Not(testing::HasSubstr("OLD=old")));
  EXPECT_STREQ(std::getenv("GROUNDGLASS_TEST_OLD"), "old");
}

TEST(ChildProcess, TheProgramInheritsNoOpenFile) {
  const int ours = open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  ASSERT_GE(ours, 0);
  // ls itself opens the folder that it lists, as 3.
  EXPECT_EQ(RunProgram({"ls", "/proc/self/fd"}).output, "0\n1\n2\n3\n");
  close(ours);
}

TEST(ChildProcess, TheEndOfTheInputIsSeenWhileOtherProgramsRun) {
  ChildProcess first({"cat"});
  ChildProcess second({"cat"});
  const std::string text = "first";
  EXPECT_TRUE(first.Write({reinterpret_cast<const uint8_t*>(text.data()), text.size()}));
  EXPECT_EQ(first.Finish().output, "first");
  EXPECT_EQ(second.Finish().output, "");
}

TEST(ChildProcess, AnObjectThatIsDestroyedEndsItsProgram) {
  { const ChildProcess program({"sleep", "1000000"}); }
  ExpectNoChildIsLeft();
}

TEST(ChildProcess, ManyThreadsRunProgramsAtOnceAndLeaveNothingOpen) {
  const auto count_open = [] {
    const std::filesystem::directory_iterator entries("/proc/self/fd");
    return std::distance(begin(entries), end(entries));
  };
  const auto open_before = count_open();
  std::atomic<int> num_right = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      const std::string text(100000 + i, 'x');
      for (int k = 0; k < 10; ++k) num_right += RunProgram({"cat"}, {}, text).output == text;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(num_right, 40);
  EXPECT_EQ(count_open(), open_before);
  ExpectNoChildIsLeft();
}

TEST(ChildProcess, LastWordsAreTheLastLineOfTheErrorsElseOfTheOutput) {
  EXPECT_EQ(LastWords({1, "out\n", "first\nsecond 50%\r\n \n"}), "second 50%");
  EXPECT_EQ(LastWords({1, "out\n", "\n"}), "out");
  EXPECT_EQ(LastWords({1, "", ""}), "it said nothing");
}

}  // namespace
}  // namespace groundglass
