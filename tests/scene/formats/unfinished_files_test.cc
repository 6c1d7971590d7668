// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/unfinished_files.h"

#include "scene/formats/atomic_file.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// How a process ends that gets the signal while it is at work; `work` is called with what says so,
// and never returns.
int StatusAfter(int signal, const std::function<void(const std::function<void()>& wait)>& work) {
  std::array<int, 2> at_work = {};
  if (pipe(at_work.data()) != 0) return -1;
  const pid_t child = fork();
  if (child == 0) {
    RemoveUnfinishedFilesOnSignals();
    work([&] {
      if (write(at_work[1], "!", 1) != 1) _exit(2);
      for (;;) pause();
    });
    _exit(1);
  }
  char byte = 0;
  EXPECT_EQ(read(at_work[0], &byte, 1), 1);
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  for (const int end : at_work) close(end);
  return status;
}

TEST(UnfinishedFiles, AProgramThatIsEndedLeavesNoneAndTheOldFileStays) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    folder.Write("elevation.tif", "before");
    const int status = StatusAfter(signal, [&](const std::function<void()>& wait) {
      StreamFileAtomically(folder / "elevation.tif", [&](const ByteSink& append) {
        append("half");
        wait();
      });
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
    EXPECT_EQ(fs::file_size(folder / "elevation.tif"), 6);
  }
}

TEST(UnfinishedFiles, WritersWithANameOfTheirOwnToo) {
  const TemporaryFolder folder;
  const int status = StatusAfter(SIGTERM, [&](const std::function<void()>& wait) {
    WriteFileAtomically(folder / "film.mp4", [&](const fs::path& temporary) {
      WriteFileAtomically(temporary, "half");
      wait();
    });
  });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(UnfinishedFiles, AnInterruptSaysWhatItWasToldToSay) {
  const TemporaryFolder folder;
  const auto said_at = [&](int signal) {
    const int status = StatusAfter(signal, [&](const std::function<void()>& wait) {
      if (freopen((folder / "said").c_str(), "w", stderr) == nullptr) _exit(3);
      const WordsOnInterrupt words("stopped; the same command goes on from here");
      wait();
    });
    EXPECT_TRUE(WIFSIGNALED(status));
    return ReadTextFile(folder / "said");
  };
  EXPECT_EQ(said_at(SIGINT), "\nstopped; the same command goes on from here\n");
  EXPECT_EQ(said_at(SIGTERM), "");
}

// As under nohup.
TEST(UnfinishedFiles, ASignalThatIsIgnoredStaysSo) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  const int status = StatusAfter(SIGHUP, [&](const std::function<void()>& wait) {
    std::signal(SIGALRM, [](int) { _exit(7); });
    alarm(1);
    wait();
  });
  std::signal(SIGHUP, before);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

// More at once than there are slots: written all the same.
TEST(UnfinishedFiles, ManyAtOnceAreWritten) {
  const TemporaryFolder folder;
  std::vector<FileToWrite> files;
  for (int i = 0; i < 200; ++i) files.push_back({folder / std::to_string(i), "whole"});
  WriteFilesAtomically(files);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 200);
}

}  // namespace
}  // namespace groundglass
