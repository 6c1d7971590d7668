// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to session.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace groundglass {

// What a file holds; nothing if there is none, or no path.
std::optional<std::string> BytesOf(const std::filesystem::path& file);

}  // namespace groundglass
