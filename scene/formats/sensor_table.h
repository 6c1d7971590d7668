// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace groundglass {

// How many times larger the diagonal of 36 mm x 24 mm is than that of a camera's sensor, as the
// newest of lensfun's tables in this folder has it (https://lensfun.github.io; installed apart:
// liblensfun-data-v1 on Debian). The camera goes by the model that its photographs name, in any
// case. Nothing where the folder or the camera is missing.
std::optional<double> FindCropFactor(const std::string& maker,
                                     const std::string& model,
                                     const std::filesystem::path& folder);

// Whether there are tables at all.
bool HasSensorTables(const std::filesystem::path& folder);

}  // namespace groundglass
