// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>
#include <string_view>

namespace groundglass {

// What the JSON library found wrong, in words for the person who wrote the file: "line 3, column 5:
// unexpected '}'", "\"frames\" is missing", "expected a number, found a string". `what` is its
// exception's text; one that is not known comes back without the library's own numbering.
std::string TellJsonFault(std::string_view what);

}  // namespace groundglass
