// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace groundglass {

// Writes a file beside its place and renames it into place, so that a stop at any moment leaves
// no half file. Folders are made as needed. Throws Error.
void WriteFileAtomically(const std::filesystem::path& file, const std::string& bytes);

// The same for writers that want a path: `write` gets a temporary name with the same extension in
// the same folder. If it throws, nothing is left behind.
void WriteFileAtomically(const std::filesystem::path& file,
                         const std::function<void(const std::filesystem::path&)>& write);

}  // namespace groundglass
