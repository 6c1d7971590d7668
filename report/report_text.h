// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <kainjow/mustache.hpp>

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What the report's page shows, as text; its template makes it safe for HTML.

// A number as people write it: as many decimals as its standard deviation gives sense to (two
// digits of the deviation), four significant digits if that is not known (0). True minus sign.
std::string FormatRounded(double value, double sigma = 0);
// The deviation itself, to two digits.
std::string FormatSigma(double sigma);
// "87 %"; "< 1 %" and "> 99 %" rather than a false 0 or 100.
std::string FormatShare(double share);

// Where there is no number.
constexpr char kNoNumber[] = "\u2013";

// "1 face", "3 faces".
std::string Plural(size_t count, const std::string& noun);

// A file's name in the address of a link: "100 %.mp4" is "100%20%25.mp4".
std::string EncodeForAddress(const std::string& name);

// Entries that the template parts from one another: text, and is_later for all but the first.
kainjow::mustache::data TextListData(const std::vector<std::string>& texts);

}  // namespace groundglass
