// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace groundglass {

// Parts of the report, as HTML. unit: the model's, as it is written behind a number, " ft".

// How much of each face the photographs show, from coverage.json.
std::string FormatCoverageSection(const nlohmann::json& coverage, const std::string& unit);

// What was odd about the scene, and what to do; empty if nothing was.
std::string FormatWarningSection(const std::vector<std::string>& warnings);

// Where the model is off; empty if it is nowhere.
std::string FormatModelErrorSection(const std::vector<ModelError>& errors, const std::string& unit);

}  // namespace groundglass
