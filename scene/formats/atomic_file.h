// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// Files are written beside their place and renamed into it once every byte is known to be on the
// disk, so that neither a stop at any moment nor a full disk leaves half a file or spoils the one
// that was there. Folders are made as needed. All throw Error, and leave nothing behind then.

void WriteFileAtomically(const std::filesystem::path& file, std::string_view bytes);

// Throws Error if both are one file: what is read is never written over.
void RequireOtherFile(const std::filesystem::path& input, const std::filesystem::path& output);

// Files that are of use together only: none takes its place before every byte of all of them is on
// the disk.
struct FileToWrite {
  std::filesystem::path file;
  std::string bytes;
};
void WriteFilesAtomically(const std::vector<FileToWrite>& files);

// Encoded bytes as the writers take them.
inline std::string_view AsText(const std::vector<unsigned char>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// For what is too large for memory: `write` is given what appends to the file.
using ByteSink = std::function<void(std::string_view bytes)>;
void StreamFileAtomically(const std::filesystem::path& file,
                          const std::function<void(const ByteSink& append)>& write);

// For other programs, which want a path: `write` gets a temporary name with the same extension in
// the same folder, and throws if the program fails.
void WriteFileAtomically(const std::filesystem::path& file,
                         const std::function<void(const std::filesystem::path&)>& write);

// Whether a file's name is such a temporary one: a program that was killed may leave some.
bool IsTemporaryName(const std::filesystem::path& file);

}  // namespace groundglass
