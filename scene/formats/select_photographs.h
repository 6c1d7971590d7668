// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/photograph_name.h"
#include "scene/formats/scene.h"

#include <string>
#include <vector>

namespace groundglass {

// Photographs are called by name or file, as scene/photograph_name.h finds them, those included
// that cannot be used or were left out.

// All of them, in natural order.
std::vector<PhotographName> AllPhotographNames(const Scene& scene);

// The scene's own names of these photographs. Throws Error if it has none of one of these names,
// with the names there are. place: where the names stand, for the message ("option --only").
std::vector<std::string> FindPhotographNames(const Scene& scene,
                                             const std::vector<std::string>& names,
                                             const std::string& place);

// Throws Error as above.
void RequirePhotographs(const Scene& scene,
                        const std::vector<std::string>& names,
                        const std::string& place);

// The photograph's name as the scene has it; as it is, if the scene has none such.
std::string NameInScene(const std::string& name, const Scene& scene);

// Leaves only these photographs in the scene, in the scene's order; all if none is named.
void KeepPhotographs(const std::vector<std::string>& names, Scene& scene);

// Photographs of these names are not needed: those that cannot be read are left out.
void ForgiveUnreadable(const std::vector<std::string>& names, Scene& scene);

}  // namespace groundglass
