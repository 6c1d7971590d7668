// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What photographs are called, given their paths below the folder of images ("north/0001.jpg"):
// the stem ("0001"), or, for those whose stem others have too, the folders before it as well
// ("north_0001"). Two names are the same only if two paths differ in nothing but the extension.
std::vector<std::string> NamePhotographs(const std::vector<std::string>& paths);

// A path without an image's extension.
std::string WithoutExtension(const std::string& path);

// Finds which of these paths another program's name of an image means, folders and extension as far
// as they help: the path itself, else the one that shares most from the end on, else the same
// without extension, else in any case; nothing if none or several do. Absolute paths and
// backslashes are understood.
class ImagePathFinder {
 public:
  explicit ImagePathFinder(const std::vector<std::string>& paths);
  std::optional<size_t> Find(const std::string& name) const;

 private:
  static constexpr int kNumAttempts = 3;
  using Parts = std::vector<std::string>;
  static void Simplify(int attempt, Parts& parts);

  std::array<std::vector<Parts>, kNumAttempts> parts_of_path_;
  std::array<std::map<std::string, std::vector<size_t>>, kNumAttempts> paths_of_last_part_;
};

// The files of a folder and of those below it, as paths in it with slashes, in natural order;
// hidden ones left out; none if there is no folder.
std::vector<std::string> ListFilesBelow(const std::filesystem::path& folder);

// Those of them that are images by content or by name.
std::vector<std::string> ListImagePaths(const std::filesystem::path& folder);

}  // namespace groundglass
