// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/keyframes.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"
#include "session/file_bytes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr int kKeyframeWidthPx = 1280;  // of cameras that are read; what flies has its own

Camera ReadKeyframe(const fs::path& file) {
  const ViewTag tag = ReadView(file);
  const int height_px = std::max(1, static_cast<int>(std::lround(kKeyframeWidthPx / tag.aspect)));
  return CameraFromTag(tag, kKeyframeWidthPx, height_px);
}

}  // namespace

Keyframes::Keyframes(const fs::path& folder) : folder_(folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    if (entry.path().extension() == ".view") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.stem().string(), b.stem().string());
  });
  for (const fs::path& file : files) {
    cameras_.push_back(ReadKeyframe(file));
    last_stem_ = file.stem().string();
    const std::optional<double> number = ParseNumber(file.stem().string());
    if (number && *number < 1e6) last_number_ = std::max(last_number_, static_cast<int>(*number));
  }
}

void Keyframes::Add(const Camera& camera, double lookat_distance) {
  int number = last_number_ + 1;
  while (fs::exists(folder_ / (std::to_string(number) + ".view"))) ++number;
  const std::string stem = std::to_string(number);
  const fs::path file = folder_ / (stem + ".view");
  if (!last_stem_.empty() && !NaturalLess(last_stem_, stem)) {
    throw Error(folder_,
                "has " + Quote(last_stem_ + ".view") + ", which comes after " + stem +
                    ".view in a film; call the files 1.view, 2.view, ... to add some here");
  }
  const std::string text =
      FormatView(TagFromCamera(camera, lookat_distance), "a keyframe of `groundglass view`");
  WriteFileAtomically(file, text);
  last_number_ = number;
  cameras_.push_back(camera);
  added_.push_back({file, text, cameras_.size() - 1});
}

bool Keyframes::RemoveLast() {
  if (added_.empty()) return false;
  const Added last = added_.back();
  added_.pop_back();
  const std::optional<std::string> bytes = BytesOf(last.file);
  if (bytes && *bytes != last.text) {
    throw Error(last.file, "was changed by somebody else since it was added; it stays");
  }
  if (bytes) fs::remove(last.file);
  // One behind it may be there still, that could not be removed.
  if (last.camera + 1 == cameras_.size()) --last_number_;
  cameras_.erase(cameras_.begin() + static_cast<std::ptrdiff_t>(last.camera));
  return true;
}

}  // namespace groundglass
