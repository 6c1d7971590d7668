// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// The word among `known` that `word` was most likely meant to be: a few letters off, or cut short.
std::optional<std::string> FindNearest(const std::string& word,
                                       const std::vector<std::string>& known);

}  // namespace groundglass
