// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>

namespace groundglass {

// The scene of a brick hall that comes with the project.
inline const std::filesystem::path kBrick =
    std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";

}  // namespace groundglass
