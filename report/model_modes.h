// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace groundglass {

// Which photograph each place of the model's pages is from, for the page's script, as JSON to stand
// within a <script>: "names" of the photographs by their numbers, from 1, and "pages", PNGs in
// Base64 whose red and green are a number's lower and upper byte. Empty without provenance_N.png,
// and where it would have more bytes. Error for pictures that cannot be read.
std::string ModelModesJson(const std::filesystem::path& folder, size_t max_bytes);

}  // namespace groundglass
