// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace groundglass {

// Bad input: a file, an option, sizes that do not fit. what() is one line for the person at the
// keyboard: the place, what was wrong, what was expected. Programs print it and exit with 1.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  // "FILE: MESSAGE"
  Error(const std::filesystem::path& file, const std::string& message)
      : std::runtime_error(file.string() + ": " + message) {}
  // "FILE:LINE: MESSAGE"; lines count from 1.
  Error(const std::filesystem::path& file, int line, const std::string& message)
      : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + message) {}
};

}  // namespace groundglass
