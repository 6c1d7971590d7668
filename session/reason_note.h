// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to session.
#pragma once

#include <string>
#include <string_view>

namespace groundglass {

inline constexpr std::string_view kReasonMark = "% taken against the verdict: ";

// Why a person took a camera against registration's verdict, as a line of its own at the end of a
// view file, a comment to all others:
//   % taken against the verdict: seen on the slide
// The text with this reason in place of the one that it may hold; without the line if it is empty.
// Every other byte stays.
std::string WithReason(const std::string& view_text, const std::string& reason);

// The reason that the text holds; empty if none.
std::string ReasonIn(const std::string& view_text);

}  // namespace groundglass
