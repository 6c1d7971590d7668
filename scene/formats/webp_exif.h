// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <string>

namespace groundglass {

// The EXIF block of a WebP file, from its TIFF header on, which OpenImageIO's reader of WebP passes
// over; empty if there is none, or the file is no WebP.
std::string ReadWebpExif(const std::filesystem::path& file);

}  // namespace groundglass
