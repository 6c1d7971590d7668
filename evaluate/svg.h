// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cstdio>
#include <string>

namespace groundglass {

// For plots that are written as text.

// Appends what printf would print; cut after 599 characters.
template <typename... Values>
void AppendSvg(std::string& svg, const char* format, Values... values) {
  char buffer[600];
  std::snprintf(buffer, sizeof buffer, format, values...);
  svg += buffer;
}

// Text that XML takes for markup, escaped.
std::string EscapedForSvg(const std::string& text);

// The head of a drawing of this size on white, with a title at the left.
std::string SvgHead(double width, double height, double title_left, const std::string& title);

}  // namespace groundglass
