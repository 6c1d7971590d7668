// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/untagged.h"

#include <system_error>

namespace groundglass {

namespace fs = std::filesystem;

bool HasTagTable(const fs::path& scene_folder) {
  std::error_code error;
  return fs::is_regular_file(scene_folder / "tags.csv", error) &&
         !fs::is_directory(scene_folder / "views", error);
}

std::string DescribeUntagged(const std::string& name,
                             const fs::path& scene_folder,
                             const std::optional<fs::path>& given_views) {
  std::string expected = "views/" + name + ".view";
  if (given_views) {
    expected = "a .view file in " + given_views->string() + " for " + name;
  } else if (HasTagTable(scene_folder)) {
    expected = "a row in tags.csv for " + name;
  }
  return "photograph without a tag; expected " + expected;
}

}  // namespace groundglass
