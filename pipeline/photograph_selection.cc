// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "pipeline/photograph_selection.h"

#include "invrender/selection.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/photograph_name.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

// Leaves out the photographs whose masks from --masks cannot be used, and tells why.
std::vector<std::string> DropThoseWithFaultyMasks(const std::filesystem::path& folder,
                                                  std::vector<BakePhotograph>& photographs) {
  std::vector<std::string> faults;
  std::erase_if(photographs, [&](const BakePhotograph& photograph) {
    const auto& file = photograph.mask_file;
    if (!file || *file != folder / file->filename()) return false;
    try {
      const Image16 mask = ReadLabels(*file);
      if (mask.width == photograph.camera.width_px && mask.height == photograph.camera.height_px) {
        return false;
      }
      faults.push_back(Error(*file,
                             "mask has " + std::to_string(mask.width) + " x " +
                                 std::to_string(mask.height) + " pixels, its photograph " +
                                 std::to_string(photograph.camera.width_px) + " x " +
                                 std::to_string(photograph.camera.height_px))
                           .what());
    } catch (const Error& error) {
      faults.push_back(error.what());
    }
    faults.back() += "; " + photograph.name + " is left out of the texture";
    return true;
  });
  return faults;
}

// Those that cannot be used or were left out included: a table that names them is right.
std::vector<PhotographName> AllNames(const Scene& scene) {
  std::vector<PhotographName> names = NamesOf(scene.photographs);
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    const Photograph& photograph = unreadable.photograph;
    names.push_back({photograph.name, photograph.image_file.filename().string()});
  }
  for (const std::string& name : scene.left_out) names.push_back({name, ""});
  std::sort(names.begin(), names.end(), [](const PhotographName& a, const PhotographName& b) {
    return NaturalLess(a.name, b.name);
  });
  return names;
}

}  // namespace

std::vector<std::string> NarrowPhotographs(const PhotographSelection& selection,
                                           const Scene& scene,
                                           std::vector<BakePhotograph>& photographs) {
  std::vector<std::string> faults;
  // That the scene has them all is known; some may be missing here for other reasons.
  std::vector<std::string> exclude = selection.exclude;
  std::erase_if(exclude, [&](const std::string& name) {
    return std::none_of(
        photographs.begin(), photographs.end(), [&](const BakePhotograph& photograph) {
          return photograph.name == name || photograph.image_file.filename() == name;
        });
  });
  ExcludePhotographs(exclude, photographs);
  if (photographs.empty()) return faults;
  if (selection.masks_folder) {
    UseMasks(*selection.masks_folder, photographs);
    faults = DropThoseWithFaultyMasks(*selection.masks_folder, photographs);
  }
  const std::filesystem::path pairs = scene.folder / "pairs.csv";
  if (std::filesystem::exists(pairs)) {
    RestrictToPairs(pairs, scene.model, photographs, AllNames(scene));
  }
  if (!selection.only_faces.empty()) {
    RestrictToFaces(scene.model, FindFaces(scene.model, selection.only_faces), photographs);
  }
  return faults;
}

void CheckSelection(const PhotographSelection& selection, const Scene& scene) {
  std::vector<BakePhotograph> photographs;
  for (const Photograph& photograph : scene.photographs) {
    BakePhotograph& bake = photographs.emplace_back();
    bake.name = photograph.name;
    bake.image_file = photograph.image_file;
    bake.camera.width_px = photograph.size.width;
    bake.camera.height_px = photograph.size.height;
  }
  NarrowPhotographs(selection, scene, photographs);
  if (photographs.empty()) {
    throw Error(
        "option --exclude: it leaves no photograph for the texture; register corrects tags "
        "alone");
  }
}

}  // namespace groundglass
