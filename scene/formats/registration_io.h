// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"
#include "scene/tie_use.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// registration.json (docs/registration-json.md).
std::string FormatRegistrations(const std::vector<Registration>& registrations,
                                const std::vector<ModelError>& model_errors = {},
                                const std::vector<std::string>& warnings = {},
                                const TieUse& ties = {});
std::vector<Registration> ReadRegistrations(const std::filesystem::path& file);
// None where the file says nothing of them.
std::vector<ModelError> ReadModelErrors(const std::filesystem::path& file);
// What a person should know of the whole, one line each.
std::vector<std::string> ReadRegistrationWarnings(const std::filesystem::path& file);
// Nothing where the file says nothing of it.
TieUse ReadTieUse(const std::filesystem::path& file);

}  // namespace groundglass
