// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/scene_folder.h"

#include <string>
#include <vector>

namespace groundglass {

// All photographs that the scene has, those that cannot be used or were left out included, in
// natural order.
std::vector<std::string> PhotographNames(const Scene& scene);

// Throws Error if the scene has no photograph of one of these names, with the names there are.
// place: where the names stand, for the message ("option --only").
void RequirePhotographs(const Scene& scene,
                        const std::vector<std::string>& names,
                        const std::string& place);

// The names of these photographs, which may also be given by file name ("s5.jpg"). Throws Error as
// above.
std::vector<std::string> FindPhotographNames(const Scene& scene,
                                             const std::vector<std::string>& names,
                                             const std::string& place);

// Leaves only these photographs in the scene, in the scene's order; all if none is named.
void KeepPhotographs(const std::vector<std::string>& names, Scene& scene);

// Photographs of these names are not needed: those that cannot be read are left out.
void ForgiveUnreadable(const std::vector<std::string>& names, Scene& scene);

}  // namespace groundglass
