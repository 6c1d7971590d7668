// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/film.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace groundglass {
namespace {

constexpr int kProgramNotFound = 127;

// The ffmpeg program with frames going in on its standard input. The input is a socket rather than
// a pipe, so that a program that has died is an error here and not a signal to the whole process.
class Encoder {
 public:
  Encoder(const std::vector<std::string>& command) : program_(command.front()) {
    messages_ = std::tmpfile();
    int ends[2] = {-1, -1};
    if (!messages_ || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      throw Error("film: cannot connect to " + program_ + ": " + std::strerror(errno));
    }
    std::vector<char*> arguments;
    for (const std::string& argument : command) {
      arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    input_ = ends[0];
    process_ = fork();
    if (process_ == 0) {
      dup2(ends[1], STDIN_FILENO);
      dup2(fileno(messages_), STDOUT_FILENO);
      dup2(fileno(messages_), STDERR_FILENO);
      execvp(arguments[0], arguments.data());
      _exit(kProgramNotFound);
    }
    close(ends[1]);
    if (process_ < 0) throw Error("film: cannot start " + program_ + ": " + std::strerror(errno));
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() {
    Close();
    if (process_ > 0) waitpid(process_, nullptr, 0);
    if (messages_) std::fclose(messages_);
  }

  // False if the program takes no more; Finish() then tells why.
  bool Write(const std::vector<uint8_t>& bytes) {
    size_t sent = 0;
    while (sent < bytes.size()) {
      const ssize_t now = send(input_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (now < 0 && errno == EINTR) continue;
      if (now < 0) return false;
      sent += static_cast<size_t>(now);
    }
    return true;
  }

  // Waits for the program to end; Error with its own last words if it failed.
  void Finish() {
    Close();
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    // It may end with 0 although it could not write the end; with -loglevel error, whatever it says
    // is a failure.
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && LastMessage().empty()) return;
    if (WIFEXITED(status) && WEXITSTATUS(status) == kProgramNotFound) {
      throw Error("film: the program " + program_ +
                  " was not found; install it (Debian: apt-get install ffmpeg)");
    }
    const std::string message = LastMessage();
    throw Error("film: " + program_ +
                " failed: " + (message.empty() ? "it said nothing" : message));
  }

 private:
  void Close() {
    if (input_ >= 0) close(input_);
    input_ = -1;
  }

  std::string LastMessage() {
    std::rewind(messages_);
    std::string last;
    char line[500];
    while (std::fgets(line, sizeof(line), messages_)) {
      std::string text = line;
      while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
      if (!text.empty()) last = text;
    }
    return last;
  }

  std::string program_;
  FILE* messages_ = nullptr;
  int input_ = -1;
  pid_t process_ = -1;
};

std::vector<std::string> EncoderCommand(const Image8& first_frame,
                                        const FilmOptions& options,
                                        const std::filesystem::path& file) {
  return {options.ffmpeg.string(),
          "-hide_banner",
          "-loglevel",
          "error",
          "-nostdin",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          std::to_string(first_frame.width) + "x" + std::to_string(first_frame.height),
          "-r",
          std::to_string(options.frames_per_second),
          "-i",
          "pipe:0",
          // Players take untagged small films for BT.601 and large ones for BT.709: say which.
          "-vf",
          "scale=out_color_matrix=bt709:out_range=tv",
          "-c:v",
          "libx264",
          "-pix_fmt",
          "yuv420p",
          "-preset",
          "medium",
          "-crf",
          std::to_string(options.quality),
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "iec61966-2-1",
          // x264's output depends on its number of threads.
          "-threads",
          "4",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-movflags",
          "+faststart",
          file.string()};
}

}  // namespace

void FilmOptions::Check() const {
  if (!(frames_per_second > 0 && frames_per_second <= 240)) {
    throw OptionError("film options: frames_per_second", "must be above 0 and at most 240");
  }
  CheckFromTo(quality, 0, 51, "film options: quality");
  if (ffmpeg.empty()) throw Error("film options: ffmpeg names no program");
}

void WriteFilm(const std::filesystem::path& file,
               int num_frames,
               const std::function<Image8(int)>& frame,
               const FilmOptions& options,
               const Progress& progress) {
  options.Check();
  if (num_frames < 1) throw Error(file, "a film needs at least one frame");
  Image8 picture = frame(0);
  if (picture.channels != 3 || picture.width % 2 != 0 || picture.height % 2 != 0) {
    throw Error(file,
                "frames must have 3 channels and an even size; this one is " +
                    std::to_string(picture.width) + " x " + std::to_string(picture.height) + " x " +
                    std::to_string(picture.channels));
  }
  const size_t frame_size = picture.values.size();
  WriteFileAtomically(file, [&](const std::filesystem::path& temporary) {
    Encoder encoder(EncoderCommand(picture, options, temporary));
    for (int i = 0; i < num_frames; ++i) {
      if (i > 0) picture = frame(i);
      if (picture.values.size() != frame_size) throw Error(file, "its frames differ in size");
      if (!encoder.Write(picture.values)) break;
      if (progress) progress(i + 1, num_frames, "frame");
    }
    encoder.Finish();
  });
}

}  // namespace groundglass
