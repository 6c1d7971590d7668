// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/folder_lock.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What one stage of a job left in the folder, so that it can be kept, or removed.
struct StageRecord {
  std::string name;                // "register"
  std::string key;                 // HashText of all that its files depend on
  bool is_complete = false;        // else the files are those that it meant to write
  std::vector<std::string> files;  // relative to the folder
  // What the files held when they were written, so that one that was changed since is noticed.
  std::map<std::string, std::string> sha256_of_files;
};

// What an output folder was made from: manifest.json (docs/output-folder.md). Paths are relative
// to the scene, so that the same inputs give the same bytes wherever they lie.
struct Manifest {
  std::string version;
  std::string command;
  uint64_t seed = 0;
  std::map<std::string, std::string> options;
  std::map<std::string, std::string> sha256_of_inputs;
  std::vector<StageRecord> stages;
};
std::string FormatManifest(const Manifest& manifest);

// SHA-256 of a file's bytes, 64 hexadecimal digits. Error if it cannot be read.
std::string HashFile(const std::filesystem::path& file);
std::string HashText(const std::string& text);

// Makes the folder if need be. Accepts an empty folder and one that this program made before (its
// manifest.json says so); any other folder that holds something is refused with an Error, so that
// nobody's files are written over. The folder is held (FolderLock) as long as what is returned
// lives; Error if another process holds it.
FolderLock PrepareOutputFolder(const std::filesystem::path& folder);

// The folder's manifest.json; an empty one if not all of it is understood, nothing if there is none
// or it is another program's.
std::optional<Manifest> ReadManifest(const std::filesystem::path& folder);
// It is there and cannot be read, so that nobody knows what the files were made with.
bool IsManifestDamaged(const std::filesystem::path& folder);

// Whether a folder is one that a run left: it holds a registration.json, or a manifest.json of this
// program's. A scene may hold a model.glb too.
bool IsOutputFolder(const std::filesystem::path& folder);

// The photographs that a run's texture is from, each of which left a mask in faces/, in the order
// in which provenance_N.png numbers them, from 1.
std::vector<std::string> NumberedPhotographs(const std::filesystem::path& folder);

void WriteManifest(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace groundglass
