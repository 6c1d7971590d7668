// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/cli/program.h"

#include "tests/support/temporary_folder.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace groundglass {

namespace fs = std::filesystem;

namespace {

// For the shell: everything but a quote stands for itself between quotes.
std::string Quoted(const std::string& argument) {
  std::string quoted = "'";
  for (char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

ProgramRun RunProgram(const std::vector<std::string>& arguments) {
  const TemporaryFolder work;
  std::string command = Quoted(GROUNDGLASS_PROGRAM);
  for (const std::string& argument : arguments) command += " " + Quoted(argument);
  command += " >" + Quoted((work / "out").string()) + " 2>" + Quoted((work / "err").string()) +
             " </dev/null";
  const int status = std::system(command.c_str());
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
