// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/scene_folder.h"

#include "scene/error.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/scene_reader.h"
#include "scene/formats/select_photographs.h"

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// So many photographs' faults are told where none of them can be used.
constexpr size_t kMostReasons = 3;

}  // namespace

Scene ReadScene(const fs::path& folder, const SceneOptions& options) {
  SceneReading reading = SceneReader(folder, options).Read();
  if (!reading.scene_faults.empty()) throw Error(reading.scene_faults.front());
  Scene scene = std::move(reading.check.scene);
  KeepPhotographs(FindPhotographNames(scene, options.only, "option --only"), scene);
  ForgiveUnreadable(FindPhotographNames(scene, options.exclude, "option --exclude"), scene);
  if (scene.photographs.empty()) {
    // One file that is at fault is told as it is; the others are told as well.
    std::string reasons = "no photograph that can be used";
    for (size_t i = 0; i < scene.unreadable.size(); ++i) {
      const std::string& reason = scene.unreadable[i].reasons.front();
      if (i == 0) reasons = reason;
      if (i > 0 && i < kMostReasons) reasons += "; " + reason;
    }
    if (scene.unreadable.size() > kMostReasons) {
      reasons += "; and " + std::to_string(scene.unreadable.size() - kMostReasons) +
                 " more; groundglass check tells them all";
    }
    throw scene.unreadable.empty() ? Error(folder, reasons) : Error(reasons);
  }
  scene.warnings.insert(
      scene.warnings.end(), reading.stray_faults.begin(), reading.stray_faults.end());
  return scene;
}

SceneCheck CheckScene(const fs::path& folder, const SceneOptions& options) {
  return SceneReader(folder, options).Read().check;
}

SceneCheck ScanScene(const fs::path& folder, const SceneOptions& options) {
  return SceneReader(folder, options).Read(false).check;
}

std::string ImageName(const Scene& scene, const Photograph& photograph) {
  return photograph.image_file.lexically_relative(scene.folder / "images").generic_string();
}

const Photograph* FindUsablePhotograph(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(
      scene.photographs.begin(), scene.photographs.end(), [&](const Photograph& photograph) {
        return photograph.name == name;
      });
  return found == scene.photographs.end() ? nullptr : &*found;
}

}  // namespace groundglass
