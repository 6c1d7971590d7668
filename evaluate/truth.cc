// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/truth.h"

#include "scene/error.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

void SortByName(std::vector<NamedCamera>& cameras) {
  std::sort(cameras.begin(), cameras.end(), [](const NamedCamera& a, const NamedCamera& b) {
    return NaturalLess(a.name, b.name);
  });
}

std::vector<NamedCamera> ReadColmapCamerasByName(const fs::path& folder) {
  std::vector<NamedCamera> cameras = ReadColmapModel(folder);
  std::vector<std::string> images;
  for (const NamedCamera& camera : cameras) images.push_back(camera.name);
  const std::vector<std::string> names = NamePhotographs(images);
  for (size_t i = 0; i < cameras.size(); ++i) cameras[i].name = names[i];
  SortByName(cameras);
  return cameras;
}

std::vector<fs::path> FindFiles(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

}  // namespace

Truth ReadTruth(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw Error(folder, "no such folder; expected a scene's truth folder with cameras/ in it");
  }
  Truth truth;
  truth.folder = folder;
  truth.cameras = ReadColmapCamerasByName(folder / "cameras");
  for (const fs::path& file : FindFiles(folder / "novel", ".view")) {
    NovelView view;
    view.name = file.stem().string();
    view.tag = ReadView(file);
    view.image_file = folder / "novel" / (view.name + ".png");
    view.faces_file = folder / "novel" / (view.name + "_faces.png");
    for (const fs::path& needed : {view.image_file, view.faces_file}) {
      if (!fs::exists(needed)) {
        throw Error(file, "this novel view needs " + needed.filename().string() + " beside it");
      }
    }
    truth.novel_views.push_back(view);
  }
  if (fs::is_directory(folder / "masks_model")) truth.masks_model_folder = folder / "masks_model";
  if (fs::is_directory(folder / "masks_occ")) truth.masks_occ_folder = folder / "masks_occ";
  if (fs::is_directory(folder / "surfaces")) truth.surfaces_folder = folder / "surfaces";
  return truth;
}

std::vector<NamedCamera> ReadFoundCameras(const fs::path& folder, const Truth& truth) {
  if (!fs::is_directory(folder)) throw Error(folder, "no such folder");
  std::vector<fs::path> view_files = FindFiles(folder / "views", ".view");
  if (view_files.empty()) view_files = FindFiles(folder, ".view");
  std::vector<NamedCamera> cameras;
  if (!view_files.empty()) {
    for (const fs::path& file : view_files) {
      const std::string name = file.stem().string();
      for (const NamedCamera& true_camera : truth.cameras) {
        if (true_camera.name != name) continue;
        cameras.push_back(
            {name,
             CameraFromTag(
                 ReadView(file), true_camera.camera.width_px, true_camera.camera.height_px)});
      }
    }
    SortByName(cameras);
    return cameras;
  }
  for (const fs::path& candidate : {folder, folder / "cameras"}) {
    if (FindColmapModel(candidate)) return ReadColmapCamerasByName(candidate);
  }
  // What `invrender` writes has a model to judge, and no cameras of its own.
  if (fs::exists(folder / "model.glb")) return {};
  throw Error(folder, "no cameras here; expected views/*.view, *.view, or a COLMAP model");
}

}  // namespace groundglass
