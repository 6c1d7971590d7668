// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/file_bytes.h"

#include "scene/formats/view_io.h"

#include <system_error>

namespace groundglass {

std::optional<std::string> BytesOf(const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  return ReadFileBytes(file);
}

}  // namespace groundglass
