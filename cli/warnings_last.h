// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>
#include <vector>

namespace groundglass {

// Tells warnings on stderr when it goes out of scope: after everything else that a command prints,
// where they are still on the screen, and before the error if the command ends with one.
class WarningsLast {
 public:
  // If there are any and not `quiet`, their number is told at once: the work may be long.
  WarningsLast(std::vector<std::string> warnings, bool quiet);
  ~WarningsLast();
  WarningsLast(const WarningsLast&) = delete;
  WarningsLast& operator=(const WarningsLast&) = delete;

 private:
  std::vector<std::string> warnings_;
};

// "1 warning", "3 warnings".
std::string CountWarnings(size_t number);

}  // namespace groundglass
