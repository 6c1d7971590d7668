// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>

namespace groundglass {

// Originals are never written: throws Error if this place is one of a scene's own folders (images/,
// views/, masks/, faces/) or lies within one. An output folder's are not.
void RefuseAmongInputs(const std::filesystem::path& place);

// The same for what fills a folder with a scene's own files, tags from a COLMAP model for one:
// only where there are files in it already.
void RefuseFilledInputs(const std::filesystem::path& place);

}  // namespace groundglass
