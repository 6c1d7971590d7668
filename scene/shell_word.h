// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <string>

namespace groundglass {

// A path as a shell takes it, quoted if need be, for command lines that a person copies.
std::string ShellWord(const std::filesystem::path& path);

}  // namespace groundglass
