// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/bake_photograph.h"
#include "scene/formats/photograph_name.h"
#include "scene/polygon_model.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace groundglass {

// The faces (from 0, ascending) that a person means: numbers in the model's file, from 1, ranges
// of them ("3-7"), and names, which several faces may share. Throws Error for what is none.
std::vector<int> FindFaces(const PolygonModel& model, const std::vector<std::string>& words);

// Leaves these photographs out, called as FindPhotograph knows them. Throws Error for a name that
// none has.
void ExcludePhotographs(const std::vector<std::string>& names,
                        std::vector<BakePhotograph>& photographs);

// Takes the masks (white = ignore) from this folder, NAME.png or any other image; photographs
// without one there keep their own. Throws Error if the folder has none for any of them.
void UseMasks(const std::filesystem::path& folder, std::vector<BakePhotograph>& photographs);

// Photographs texture these faces only.
void RestrictToFaces(const PolygonModel& model,
                     const std::vector<int>& faces,
                     std::vector<BakePhotograph>& photographs);

// Reads pairs.csv (`image,face` on its first line; then an image's name and a face's number or name
// on each). A face that the table names is textured only by the photographs paired with it; one
// that it does not name, by all. A line that names nothing is left out, and returned with what is
// wrong with it; a photograph that is neither among these nor among `known` (all of the scene's,
// whatever their verdict) is nothing, if those are given. Throws Error where this is no such table.
std::vector<std::string> RestrictToPairs(const std::filesystem::path& file,
                                         const PolygonModel& model,
                                         std::vector<BakePhotograph>& photographs,
                                         std::span<const PhotographName> known = {});

}  // namespace groundglass
