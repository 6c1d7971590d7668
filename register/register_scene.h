// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/register_photograph.h"
#include "scene/lens.h"
#include "scene/progress.h"
#include "scene/scene_folder.h"

#include <functional>
#include <optional>
#include <vector>

namespace groundglass {

// Corrects the tags of a scene's photographs, each by itself, on every core; results in the
// scene's order, the same whatever the number of threads. Reads the photographs and their masks.
std::vector<Registration> RegisterScene(const Scene& scene,
                                        const std::optional<Lens>& lens,
                                        const RegisterOptions& options,
                                        const Progress& progress);

}  // namespace groundglass
