// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include <string>
#include <vector>

namespace groundglass {

// What to call a column of tags.csv that has another name, in lower case, which people give it:
// "n", "photo", "x (m)". `absent`: the columns that are not there yet. Empty: nothing is known of
// it.
std::string AdviceOnColumn(const std::string& name, const std::vector<std::string>& absent);

}  // namespace groundglass
