// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace groundglass {

// What an output folder was made from: manifest.json (docs/output-folder.md). Paths are relative
// to the scene, so that the same inputs give the same bytes wherever they lie.
struct Manifest {
  std::string version;
  std::string command;
  uint64_t seed = 0;
  std::map<std::string, std::string> options;
  std::map<std::string, std::string> sha256_of_inputs;
};
std::string FormatManifest(const Manifest& manifest);

// SHA-256 of a file's bytes, 64 hexadecimal digits. Error if it cannot be read.
std::string HashFile(const std::filesystem::path& file);

// Makes the folder if need be. Accepts an empty folder and one that this program made before (its
// manifest.json says so); any other folder that holds something is refused with an Error, so that
// nobody's files are written over.
void PrepareOutputFolder(const std::filesystem::path& folder);

// True if the folder's manifest.json is exactly this one: what is there can be kept.
bool HasManifest(const std::filesystem::path& folder, const Manifest& manifest);

void WriteManifest(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace groundglass
