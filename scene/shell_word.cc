// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/shell_word.h"

#include <string_view>

namespace groundglass {

std::string ShellWord(const std::filesystem::path& path) {
  std::string text = path.string();
  const std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,:@%=";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace groundglass
