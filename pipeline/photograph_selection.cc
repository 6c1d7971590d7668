// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "pipeline/photograph_selection.h"

#include "invrender/selection.h"
#include "scene/error.h"
#include "scene/formats/ignore_mask.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/select_photographs.h"

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
      ReadIgnoreMask(*file, {photograph.camera.width_px, photograph.camera.height_px});
      return false;
    } catch (const Error& error) {
      faults.push_back(error.what());
    }
    faults.back() += "; " + photograph.name + " is left out of the texture";
    return true;
  });
  return faults;
}

std::vector<BakePhotograph> AllOf(const Scene& scene) {
  std::vector<BakePhotograph> photographs;
  for (const Photograph& photograph : scene.photographs) {
    BakePhotograph& bake = photographs.emplace_back();
    bake.name = photograph.name;
    bake.image_file = photograph.image_file;
    bake.camera.width_px = photograph.size.width;
    bake.camera.height_px = photograph.size.height;
  }
  return photographs;
}

}  // namespace

std::vector<std::string> NarrowPhotographs(const PhotographSelection& selection,
                                           const Scene& scene,
                                           std::vector<BakePhotograph>& photographs) {
  std::vector<std::string> faults;
  // That the scene has them all is known; some may be missing here for other reasons.
  std::vector<std::string> exclude = selection.exclude;
  std::erase_if(exclude, [&](const std::string& name) {
    return !FindPhotograph(name, NamesOf(photographs));
  });
  ExcludePhotographs(exclude, photographs);
  if (photographs.empty()) return faults;
  if (selection.masks_folder) {
    UseMasks(*selection.masks_folder, photographs);
    faults = DropThoseWithFaultyMasks(*selection.masks_folder, photographs);
  }
  const std::filesystem::path pairs = scene.folder / "pairs.csv";
  if (std::filesystem::exists(pairs)) {
    // Those that cannot be used or were left out included: a table that names them is right.
    const std::vector<std::string> left_out =
        RestrictToPairs(pairs, scene.model, photographs, AllPhotographNames(scene));
    faults.insert(faults.end(), left_out.begin(), left_out.end());
  }
  if (!selection.only_faces.empty()) {
    RestrictToFaces(scene.model, FindFaces(scene.model, selection.only_faces), photographs);
  }
  return faults;
}

std::vector<std::string> FindPairFaults(const Scene& scene) {
  const std::filesystem::path pairs = scene.folder / "pairs.csv";
  if (!std::filesystem::exists(pairs) || scene.model.faces.empty()) return {};
  std::vector<BakePhotograph> photographs = AllOf(scene);
  try {
    return RestrictToPairs(pairs, scene.model, photographs, AllPhotographNames(scene));
  } catch (const Error& error) {
    return {error.what()};
  }
}

std::vector<std::string> CheckSelection(const PhotographSelection& selection, const Scene& scene) {
  std::vector<BakePhotograph> photographs = AllOf(scene);
  std::vector<std::string> faults = NarrowPhotographs(selection, scene, photographs);
  if (photographs.empty()) {
    std::string unreadable;
    for (const UnreadablePhotograph& one : scene.unreadable) {
      for (const std::string& reason : one.reasons) unreadable += "\n  " + reason;
    }
    throw Error("option --exclude: it leaves no photograph for the texture" +
                (unreadable.empty() ? "; register corrects tags alone"
                                    : ", since the others cannot be read:" + unreadable));
  }
  return faults;
}

}  // namespace groundglass
