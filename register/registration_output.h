// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/register.h"
#include "scene/formats/scene_folder.h"

#include <filesystem>

namespace groundglass {

// Writes what registration found into an output folder: views/NAME.view (the hand-written files
// with their numbers corrected in place; a rejected photograph's stays as it was measured),
// registration.json, and cameras/ (COLMAP text model of all photographs, in `world`).
void WriteRegistrationOutput(const Scene& scene,
                             const RegisteredScene& registered,
                             const std::filesystem::path& out);

}  // namespace groundglass
