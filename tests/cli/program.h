// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// What the program said and how it ended.
struct ProgramRun {
  int status = -1;  // exit status; -1: it did not exit by itself
  std::string out;
  std::string err;
};

// Runs `groundglass ARGUMENTS...` as a person would.
ProgramRun RunProgram(const std::vector<std::string>& arguments);

// A copy of the brick scene with only these photographs, to be spoiled at will.
void CopyBrick(const std::filesystem::path& folder, const std::vector<std::string>& names);

std::string ReadAll(const std::filesystem::path& file);
void WriteAll(const std::filesystem::path& file, const std::string& bytes);

// Every file's path and bytes below a folder, for "nothing here has changed".
std::string Fingerprint(const std::filesystem::path& folder);

}  // namespace groundglass
