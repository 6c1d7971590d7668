// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/cli/program.h"

#include "cli/groundglass.h"
#include "tests/support/temporary_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace groundglass {

namespace fs = std::filesystem;

namespace {

// Loading the program takes longer than most of what is asked of it here. So before the first test,
// while there is one thread, a process is forked that has it loaded, and forks again for each run.
class ProgramServer : public testing::Environment {
 public:
  void SetUp() override {
    std::fflush(nullptr);
    if (pipe(requests_) != 0 || pipe(replies_) != 0) throw std::runtime_error("no pipe");
    server_ = fork();
    if (server_ < 0) throw std::runtime_error("no process");
    if (server_ == 0) {
      close(requests_[1]);
      close(replies_[0]);
      Serve();
    }
    close(requests_[0]);
    close(replies_[1]);
  }

  void TearDown() override {
    close(requests_[1]);
    close(replies_[0]);
    waitpid(server_, nullptr, 0);
  }

  // The folder holds `arguments`, each with a 0 behind it, and is given `out` and `err`; returns
  // what waitpid() says.
  int Run(const fs::path& folder) {
    // A test may have lowered its limit on file sizes, to fill a disk.
    rlimit most_bytes;
    getrlimit(RLIMIT_FSIZE, &most_bytes);
    prlimit(server_, RLIMIT_FSIZE, &most_bytes, nullptr);
    const std::string line = folder.string() + "\n";
    int status = -1;
    if (write(requests_[1], line.data(), line.size()) != static_cast<ssize_t>(line.size()) ||
        read(replies_[0], &status, sizeof(status)) != sizeof(status)) {
      throw std::runtime_error("the process that runs the program is gone");
    }
    return status;
  }

 private:
  [[noreturn]] void Serve() {
    std::string folder;
    char c = 0;
    while (read(requests_[0], &c, 1) == 1) {
      if (c != '\n') {
        folder += c;
        continue;
      }
      const pid_t run = fork();
      if (run == 0) RunIn(folder);
      int status = -1;
      waitpid(run, &status, 0);
      if (write(replies_[1], &status, sizeof(status)) != sizeof(status)) break;
      folder.clear();
    }
    _exit(0);
  }

  [[noreturn]] void RunIn(const fs::path& folder) {
    close(requests_[0]);
    close(replies_[1]);
    const auto redirect = [](const fs::path& file, int flags, int to) {
      const int from = open(file.c_str(), flags, 0600);
      dup2(from, to);
      close(from);
    };
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(folder / "out", O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(folder / "err", O_WRONLY | O_CREAT, STDERR_FILENO);
    std::string arguments = ReadAll(folder / "arguments");
    std::vector<char*> argv;
    for (size_t i = 0; i < arguments.size(); i += std::strlen(&arguments[i]) + 1) {
      argv.push_back(&arguments[i]);
    }
    const int argc = static_cast<int>(argv.size());
    argv.push_back(nullptr);
    const int status = RunGroundglass(argc, argv.data());
    std::fflush(nullptr);
    // Not exit(): some library's destructors wait for threads that a fork does not copy.
    _exit(status);
  }

  int requests_[2] = {};
  int replies_[2] = {};
  pid_t server_ = -1;
};

ProgramServer* const kProgramServer = new ProgramServer;
const testing::Environment* const kRegisteredServer =
    testing::AddGlobalTestEnvironment(kProgramServer);

}  // namespace

ProgramRun RunProgram(const std::vector<std::string>& arguments) {
  const TemporaryFolder work;
  std::string bytes = std::string("groundglass") + '\0';
  for (const std::string& argument : arguments) bytes += argument + '\0';
  WriteAll(work / "arguments", bytes);
  const int status = kProgramServer->Run(work.path());
  return {
      WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadAll(work / "out"), ReadAll(work / "err")};
}

void CopyBrick(const fs::path& folder, const std::vector<std::string>& names) {
  const fs::path brick = fs::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
  fs::create_directories(folder / "views");
  fs::create_directories(folder / "images");
  fs::copy_file(brick / "model.osu", folder / "model.osu");
  for (const std::string& name : names) {
    fs::copy_file(brick / "views" / (name + ".view"), folder / "views" / (name + ".view"));
    fs::copy_file(brick / "images" / (name + ".jpg"), folder / "images" / (name + ".jpg"));
  }
}

std::string ReadAll(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void WriteAll(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string Fingerprint(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string fingerprint;
  for (const fs::path& file : files) {
    fingerprint += fs::relative(file, folder).string() + "\n" + ReadAll(file);
  }
  return fingerprint;
}

}  // namespace groundglass
