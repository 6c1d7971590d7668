// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/export_folder.h"

#include "scene/error.h"
#include "scene/formats/output_folder.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <string>
#include <string_view>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Both write NAME.xmp.
constexpr std::string_view kSidecars = "xmp";
constexpr std::string_view kSidecarsWithPictures = "realitycapture";

// Who reads the folder finds more there than this program may add to.
void RequireNoScene(const fs::path& folder) {
  bool holds_scene = fs::exists(folder / "views") || fs::exists(folder / "tags.csv");
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    holds_scene = holds_scene || entry.path().stem() == "model";
  }
  const bool is_scene = holds_scene && fs::exists(folder / "images");
  if (!is_scene && !IsOutputFolder(folder)) return;
  throw Error(folder,
              std::string("is ") + (is_scene ? "a scene's folder" : "the output of a run") +
                  ", where cameras would be taken for its own; give a folder of their own");
}

// The format that a file of an export folder is of; empty if it is none whose names others use.
std::string_view FormatOf(const fs::path& file) {
  const std::string ending = LowerCase(file.extension().string());
  if (ending == ".fspy") return "fspy";
  if (ending == ".cam") return "mvs-texturing";
  if (file.filename() == "cameras.csv") return "realitycapture-csv";
  if (ending != ".xmp") return "";
  return ReadTextFile(file).find("xcr:") == std::string::npos ? kSidecars : kSidecarsWithPictures;
}

// Whether both write files of the same names: pictures that suit one of them, or sidecars.
bool ShareNames(std::string_view one, std::string_view other) {
  if (one == other) return false;
  if (one == kSidecars) return other == kSidecarsWithPictures;
  if (other == kSidecars) return one == kSidecarsWithPictures;
  return true;
}

}  // namespace

void RequireExportFolder(const fs::path& folder, const CameraFormat& format) {
  RequireNoScene(folder);
  if (!format.keeps_pictures && format.name != kSidecars) return;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_regular_file(error)) continue;
    const std::string_view found = FormatOf(entry.path());
    if (found.empty() || !ShareNames(format.name, found)) continue;
    throw Error(folder,
                "holds cameras for " + std::string(found) + " (" +
                    entry.path().filename().string() + "), whose pictures or sidecars those for " +
                    std::string(format.name) + " would replace; give a folder of their own");
  }
}

}  // namespace groundglass
