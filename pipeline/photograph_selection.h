// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake.h"
#include "scene/formats/scene_folder.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// Which photographs texture which faces, beside what the verdicts and the scene's pairs.csv say.
struct PhotographSelection {
  bool accepted_only = false;           // else those in review as well, at a lower weight
  std::vector<std::string> exclude;     // photographs to leave out, by name
  std::vector<std::string> only_faces;  // FindFaces; empty: all
  // Masks (white = ignore), named after the photographs, in place of the scene's.
  std::optional<std::filesystem::path> masks_folder;
};

// Leaves those of the photographs that the selection and the scene's pairs.csv leave, each with its
// faces and its mask. One whose mask from masks_folder cannot be used is left out, and so is a line
// of pairs.csv that names nothing; returns a line for each of these. Throws Error for faces, masks
// and pairs that are wrong. A name in `exclude` that none of these has is passed over: ReadScene
// knows which names there are.
std::vector<std::string> NarrowPhotographs(const PhotographSelection& selection,
                                           const Scene& scene,
                                           std::vector<BakePhotograph>& photographs);

// What is wrong with the scene's pairs.csv, a line each; nothing where it has none.
std::vector<std::string> FindPairFaults(const Scene& scene);

// What NarrowPhotographs would return for the scene's photographs, before the work begins. Throws
// its Errors, and one if it would leave no photograph.
std::vector<std::string> CheckSelection(const PhotographSelection& selection, const Scene& scene);

}  // namespace groundglass
