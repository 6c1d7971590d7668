// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace groundglass {

// Whether a scene folder's tags are rows of its tags.csv: they are view files where it has views/.
bool HasTagTable(const std::filesystem::path& scene_folder);

// What a person is told of a photograph of this name that no tag is there for, and where one is
// expected. given_views: the folder of view files that is read in place of the scene's own tags.
std::string DescribeUntagged(const std::string& name,
                             const std::filesystem::path& scene_folder,
                             const std::optional<std::filesystem::path>& given_views = {});

}  // namespace groundglass
