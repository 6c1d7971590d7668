// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace groundglass {

// How another program ended, and all that it said.
struct ProgramResult {
  // As shells count it: what the program returned, or 128 and the signal's number if one ended it.
  int exit_code = 0;
  std::string output;  // its standard output
  std::string errors;  // its standard error
};

struct ProgramOptions {
  // Added to this process' environment for the program: name and value. Replaces what is there.
  std::vector<std::pair<std::string, std::string>> environment;
  // The Debian package that has the program, named if it is missing; empty: none is named.
  std::string package;
};

// Another program at work, with bytes going in on its standard input as they are made. The program
// inherits no other open file. What it says is kept in memory, so it never waits for us. An object
// that is destroyed before Finish() ends the program; none is left behind.
class ChildProcess {
 public:
  // command: the program and its arguments, as they are: no shell reads them. A bare name is sought
  // in PATH. Error if the program is missing or cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command,
                        const ProgramOptions& options = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // False if the program takes no more; Finish() then tells why.
  bool Write(std::span<const uint8_t> bytes);

  // Ends the input and waits for the program to end. Once only.
  ProgramResult Finish();

 private:
  void CloseAll();

  std::string program_;
  int input_ = -1;  // our end
  int output_ = -1;
  int errors_ = -1;
  int process_ = -1;
};

// Runs a program to its end, with `input` on its standard input. Errors as above; a program that
// fails is a result, not an error.
ProgramResult RunProgram(const std::vector<std::string>& command,
                         const ProgramOptions& options = {},
                         std::string_view input = {});

// The last line that is not blank of what a program said, for an error's one line: of its standard
// error, else of its standard output. "it said nothing" if there is none.
std::string LastWords(const ProgramResult& result);

}  // namespace groundglass
