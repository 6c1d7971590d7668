// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/keyframes.h"

#include "scene/formats/atomic_file.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

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
    // Behind names that are no numbers, too: those come after all numbers.
    const std::optional<double> number = ParseNumber(file.stem().string());
    if (number && *number < 1e6) last_number_ = std::max(last_number_, static_cast<int>(*number));
  }
}

void Keyframes::Add(const Camera& camera, double lookat_distance) {
  const fs::path file = folder_ / (std::to_string(last_number_ + 1) + ".view");
  WriteFileAtomically(
      file, FormatView(TagFromCamera(camera, lookat_distance), "a keyframe of `groundglass view`"));
  ++last_number_;
  cameras_.push_back(camera);
  added_.push_back(file);
}

bool Keyframes::RemoveLast() {
  if (added_.empty()) return false;
  std::error_code ignored;
  fs::remove(added_.back(), ignored);
  added_.pop_back();
  cameras_.pop_back();
  --last_number_;
  return true;
}

}  // namespace groundglass
