// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// For plots that are written as text. Debian 12 has no C++ library that draws plots into SVG
// (matplot++ came later, and is a front of the program gnuplot), and gnuplot would be a program to
// install for two pictures of known form, without the titles that name each point.

// The head of a drawing of this size on white, with a title at the left.
std::string SvgHead(double width, double height, double title_left, const std::string& title);

}  // namespace groundglass
