// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// COLMAP's own reader of a model in text ends an image's name at its first blank, where ours does
// not: one warning that names the images with blanks of the model written into this folder, and
// what to do; empty if there are none.
std::vector<std::string> TellNamesWithBlanks(const std::filesystem::path& folder,
                                             const std::vector<std::string>& image_names);

}  // namespace groundglass
