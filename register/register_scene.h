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

struct RegisteredScene {
  std::vector<Registration> registrations;  // in the scene's order, then those it calls unreadable
  std::vector<ModelError> model_errors;     // none if the photographs stay alone
  std::vector<std::string> warnings;        // lines for a person
};

// Corrects the tags of a scene's photographs, on every core: each by itself, then those that are
// accepted together (RefineAccepted), unless options.independent. The same whatever the number of
// threads. Reads the photographs and their masks; one that cannot be read, or whose solution fails,
// gets a verdict with the reason. If the common solution fails, each photograph's own is kept, with
// a warning.
RegisteredScene RegisterScene(const Scene& scene,
                              const std::optional<Lens>& lens,
                              const RegisterOptions& options,
                              const Progress& progress);

}  // namespace groundglass
