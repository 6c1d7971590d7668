// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <string>

namespace groundglass {

// What tells two files apart without reading them whole: scans without compression are large, and
// all of one length. Empty if it cannot be read.
std::string SampleOf(const std::filesystem::path& file);

// Whether two files hold the same bytes; false if one of them cannot be read.
bool IsSamePicture(const std::filesystem::path& file, const std::filesystem::path& other);

}  // namespace groundglass
