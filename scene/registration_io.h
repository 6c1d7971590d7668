// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// registration.json (docs/registration-json.md).
std::string FormatRegistrations(const std::vector<Registration>& registrations);
std::vector<Registration> ReadRegistrations(const std::filesystem::path& file);

}  // namespace groundglass
