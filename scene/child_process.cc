// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/child_process.h"

#include "scene/error.h"
#include "scene/text.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

// Why not Boost.Process (1.74): a program that stops reading kills this process with SIGPIPE, and
// its pipes are inherited by every other program that is running, which then never sees the end of
// its input. The C library's posix_spawn has neither fault, tells a missing program from one that
// fails, and may be called from any thread.

namespace groundglass {
namespace {

constexpr int kFirstFreeDescriptor = 3;  // after standard input, output and error

[[noreturn]] void FailToStart(const std::string& program, int error) {
  throw Error("cannot start " + program + ": " + std::strerror(error));
}

void CloseDescriptor(int& descriptor) {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

// The same file under a number that is not one of the standard streams', which are free if this
// process was started without them. Other programs do not inherit it.
int AboveStandardStreams(int descriptor) {
  if (descriptor < 0 || descriptor >= kFirstFreeDescriptor) return descriptor;
  const int above = fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstFreeDescriptor);
  close(descriptor);
  return above;
}

// A file without a name, in memory: however much is written, the writer need not wait for a reader.
int OpenMemoryFile(const char* purpose) {
  return AboveStandardStreams(memfd_create(purpose, MFD_CLOEXEC));
}

std::string ReadWholeDescriptor(int descriptor) {
  std::string text;
  std::array<char, 1 << 16> bytes;
  for (;;) {
    const ssize_t now =
        pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(text.size()));
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) return text;
    text.append(bytes.data(), static_cast<size_t>(now));
  }
}

std::vector<std::string> EnvironmentWith(
    const std::vector<std::pair<std::string, std::string>>& added) {
  std::vector<std::string> variables;
  for (char** variable = environ; variable && *variable; ++variable) {
    const std::string_view text = *variable;
    bool is_replaced = false;
    for (const auto& [name, value] : added) {
      is_replaced = is_replaced || text.substr(0, text.find('=')) == name;
    }
    if (!is_replaced) variables.emplace_back(text);
  }
  for (const auto& [name, value] : added) variables.push_back(name + "=" + value);
  return variables;
}

// As C's functions take a list of strings.
std::vector<char*> PointersTo(std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  for (std::string& string : strings) pointers.push_back(string.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Which descriptors a program gets as its standard input, output and error; it gets no other, so
// that it holds no lock and no pipe of ours open.
class FileActions {
 public:
  FileActions(int input, int output, int errors) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&actions_, kFirstFreeDescriptor);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  const posix_spawn_file_actions_t* Get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

// The process' number, or -1 and the reason in errno.
int Spawn(const std::vector<std::string>& command,
          const ProgramOptions& options,
          const FileActions& actions) {
  std::vector<std::string> arguments = command;
  std::vector<std::string> variables = EnvironmentWith(options.environment);
  pid_t process = -1;
  errno = posix_spawnp(&process,
                       command.front().c_str(),
                       actions.Get(),
                       nullptr,
                       PointersTo(arguments).data(),
                       PointersTo(variables).data());
  return errno == 0 ? process : -1;
}

std::string MissingProgramMessage(const std::string& program, const std::string& package) {
  return "the program " + program + " was not found" +
         (package.empty() ? "" : "; install it (Debian: apt-get install " + package + ")");
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const ProgramOptions& options) {
  if (command.empty() || command.front().empty()) throw Error("no program was named to start");
  program_ = command.front();
  // A socket rather than a pipe: writing to a program that has died is then an error here, and not
  // a signal to the whole process.
  std::array<int, 2> ends = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    FailToStart(program_, errno);
  }
  input_ = AboveStandardStreams(ends[0]);
  int input_of_program = AboveStandardStreams(ends[1]);
  output_ = OpenMemoryFile("output");
  errors_ = OpenMemoryFile("errors");
  if (input_ >= 0 && input_of_program >= 0 && output_ >= 0 && errors_ >= 0) {
    process_ = Spawn(command, options, FileActions(input_of_program, output_, errors_));
  }
  const int error = errno;
  CloseDescriptor(input_of_program);
  if (process_ >= 0) return;
  CloseAll();
  if (error == ENOENT) throw Error(MissingProgramMessage(program_, options.package));
  FailToStart(program_, error);
}

ChildProcess::~ChildProcess() {
  CloseAll();
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildProcess::Write(std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t now = send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (now < 0 && errno == EINTR) continue;
    if (now < 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(now));
  }
  return true;
}

ProgramResult ChildProcess::Finish() {
  CloseDescriptor(input_);
  int status = 0;
  int ended = -1;
  do {
    ended = waitpid(process_, &status, 0);
  } while (ended < 0 && errno == EINTR);
  process_ = -1;
  // A parent may have left us with children that no one can wait for (SIGCHLD ignored).
  if (ended < 0) throw Error("cannot learn how " + program_ + " ended: " + std::strerror(errno));
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.output = ReadWholeDescriptor(output_);
  result.errors = ReadWholeDescriptor(errors_);
  CloseAll();
  return result;
}

void ChildProcess::CloseAll() {
  CloseDescriptor(input_);
  CloseDescriptor(output_);
  CloseDescriptor(errors_);
}

ProgramResult RunProgram(const std::vector<std::string>& command,
                         const ProgramOptions& options,
                         std::string_view input) {
  ChildProcess program(command, options);
  // A program need not read all that it is offered.
  program.Write({reinterpret_cast<const uint8_t*>(input.data()), input.size()});
  return program.Finish();
}

std::string LastWords(const ProgramResult& result) {
  for (const std::string* text : {&result.errors, &result.output}) {
    const std::vector<TextLine> lines = SplitLines(*text, '\0');
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
      const std::string_view words =
          TrimBlanks(std::string_view(*text).substr(line->offset, line->size));
      if (!words.empty()) return std::string(words);
    }
  }
  return "it said nothing";
}

}  // namespace groundglass
