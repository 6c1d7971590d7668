// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/input_folders.h"

#include "scene/error.h"

#include <algorithm>
#include <array>
#include <system_error>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFolders = {"images", "views", "masks", "faces"};

bool IsScene(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "manifest.json", error) || !fs::is_directory(folder / "images", error)) {
    return false;
  }
  if (fs::exists(folder / "views", error) || fs::exists(folder / "tags.csv", error)) return true;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().stem() == "model") return true;
  }
  return false;
}

// The folder of a scene's own that this place is or lies in; empty if there is none.
fs::path FindInputFolder(const fs::path& place) {
  std::error_code error;
  fs::path folder = fs::weakly_canonical(fs::absolute(place, error), error);
  if (folder.filename().empty()) folder = folder.parent_path();
  for (; folder.has_relative_path(); folder = folder.parent_path()) {
    const bool is_called_so =
        std::find(kFolders.begin(), kFolders.end(), folder.filename().string()) != kFolders.end();
    if (is_called_so && IsScene(folder.parent_path())) return folder;
  }
  return {};
}

[[noreturn]] void Refuse(const fs::path& place, const fs::path& folder) {
  throw Error(place,
              "lies among a scene's own files (" + folder.filename().string() +
                  "/), which are never written; name a folder of its own, beside the scene");
}

}  // namespace

void RefuseAmongInputs(const fs::path& place) {
  const fs::path folder = FindInputFolder(place);
  if (!folder.empty()) Refuse(place, folder);
}

void RefuseFilledInputs(const fs::path& place) {
  const fs::path folder = FindInputFolder(place);
  std::error_code error;
  if (folder.empty() || !fs::exists(place, error)) return;
  if (fs::is_directory(place, error) && fs::is_empty(place, error)) return;
  Refuse(place, folder);
}

}  // namespace groundglass
