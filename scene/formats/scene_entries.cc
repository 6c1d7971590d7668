// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What stands in a scene's folder and is not read, though somebody has put it there to be read.
#include "scene/error.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/scene_reader.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct OtherName {
  std::string_view name;
  std::string_view expected;
};

// Folders and tables as people call them too.
constexpr std::array<OtherName, 14> kOtherNames = {{{"image", "images"},
                                                    {"img", "images"},
                                                    {"photo", "images"},
                                                    {"photos", "images"},
                                                    {"photograph", "images"},
                                                    {"photographs", "images"},
                                                    {"picture", "images"},
                                                    {"pictures", "images"},
                                                    {"view", "views"},
                                                    {"mask", "masks"},
                                                    {"face", "faces"},
                                                    {"tag", "tags"},
                                                    {"pair", "pairs"},
                                                    {"apriltag", "apriltags"}}};

constexpr std::array<std::string_view, 6> kTableExtensions = {
    ".csv", ".tsv", ".txt", ".xlsx", ".xls", ".ods"};

bool IsNearly(const std::string& stem, const std::string& expected) {
  const std::string lower = LowerCase(stem);
  return lower == expected ||
         std::any_of(kOtherNames.begin(), kOtherNames.end(), [&](const OtherName& other) {
           return other.name == lower && other.expected == expected;
         });
}

std::string WhyNoFolder(const fs::path& folder) {
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (!error) return "";
  return "cannot be opened: " + error.message() +
         "; nothing in it is read: look at its permissions";
}

}  // namespace

std::string SceneReader::WhyNotRead(const std::string& name) const {
  const fs::path path = folder_ / name;
  std::error_code error;
  if (fs::is_symlink(path, error) && !fs::exists(path, error)) {
    return "is a link that leads to nothing; put what is meant itself there, or mount what the "
           "link leads to";
  }
  if (fs::is_directory(path, error)) return WhyNoFolder(path);
  if (fs::exists(path, error)) return "";
  const bool is_table = path.has_extension();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    const fs::path file = entry.path().filename();
    std::error_code ignored;
    if (entry.is_directory(ignored) == is_table) continue;
    const std::string extension = LowerCase(file.extension().string());
    const bool is_of_kind =
        is_table ? std::find(kTableExtensions.begin(), kTableExtensions.end(), extension) !=
                       kTableExtensions.end()
                 : extension.empty();
    if (!is_of_kind || !IsNearly(file.stem().string(), path.stem().string())) continue;
    const bool is_csv = extension == ".csv";
    return "is not there, but " + file.string() + " is, which is not read; " +
           (is_table && !is_csv ? "save it as " : "rename it to ") + name;
  }
  return "";
}

void SceneReader::TellWhatIsNotRead() {
  std::error_code error;
  const bool has_other_tags = options_.views || fs::is_regular_file(folder_ / "tags.csv", error);
  for (const char* name : {"images",
                           "views",
                           "masks",
                           "faces",
                           "calibration",
                           "tags.csv",
                           "pairs.csv",
                           "apriltags.csv"}) {
    const bool is_views = std::string_view(name) == "views";
    const bool is_tags = std::string_view(name) == "tags.csv";
    if ((is_views || is_tags) && options_.views) continue;
    if (is_tags && fs::is_directory(folder_ / "views", error)) continue;
    const std::string why = WhyNotRead(name);
    if (why.empty()) continue;
    // Without pictures, or without tags, there is nothing to be done.
    if (std::string_view(name) == "images" || (is_views && !has_other_tags)) {
      Fault(Error(folder_ / name, why).what());
    } else {
      Warn(folder_ / name, why);
    }
  }
}

void SceneReader::TellOddEntries(const fs::path& folder) {
  const bool is_views = folder == folder_ / "views";
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    // Told beside its tag already (OtherThanAFile).
    const bool is_told =
        folder == folder_ / "images" && known_names_.count(path.stem().string()) > 0;
    if (path.filename().string().front() == '.') continue;
    std::error_code ignored;
    const bool is_link = entry.is_symlink(ignored);
    if (!entry.is_directory(ignored)) {
      if (entry.is_regular_file(ignored) || is_told) continue;
      Warn(path,
           is_link ? "is a link that leads to no file; put the file itself there"
                   : "is no plain file, and not read; put the file itself there");
      continue;
    }
    const std::string extension = path.extension().string();
    const std::string why = WhyNoFolder(path);
    if (IsImageExtension(extension) || LowerCase(extension) == ".view") {
      if (!is_told) Warn(path, "is a folder; put the file itself there");
    } else if (!why.empty()) {
      Warn(path, why);
    } else if (is_views) {
      const std::vector<fs::path> files = ListFiles(path);
      if (std::any_of(files.begin(), files.end(), [](const fs::path& file) {
            return LowerCase(file.extension().string()) == ".view";
          })) {
        Warn(path, "is a folder, and the view files in it are not read; put them into views/");
      }
    } else if (is_link) {
      Warn(path, "is a link to a folder, which is not followed; put the folder itself there");
    } else {
      TellOddEntries(path);
    }
  }
}

}  // namespace groundglass
