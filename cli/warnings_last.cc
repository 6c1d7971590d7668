// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/warnings_last.h"

#include <cstdio>
#include <utility>

namespace groundglass {

std::string CountWarnings(size_t number) {
  return std::to_string(number) + (number == 1 ? " warning" : " warnings");
}

WarningsLast::WarningsLast(std::vector<std::string> warnings, bool quiet)
    : warnings_(std::move(warnings)) {
  if (warnings_.empty() || quiet) return;
  std::fprintf(stderr, "%s, told at the end\n", CountWarnings(warnings_.size()).c_str());
}

WarningsLast::~WarningsLast() {
  std::fflush(stdout);
  for (const std::string& warning : warnings_) {
    std::fprintf(stderr, "groundglass: warning: %s\n", warning.c_str());
  }
}

}  // namespace groundglass
