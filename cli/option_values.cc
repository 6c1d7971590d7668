// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/option_values.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string_view>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Options that change nothing of what is written, and the seed, which has a place of its own.
constexpr std::array<std::string_view, 8> kWithoutEffect = {
    "help", "json", "quiet", "dry-run", "threads", "out", "scene", "seed"};

std::string NameOf(const CLI::Option& option) {
  const std::vector<std::string>& names = option.get_lnames();
  return names.empty() ? option.get_name() : names.back();
}

// Every file of a folder, or the one file, by its path from there.
void AddFiles(const std::string& name,
              const fs::path& path,
              std::map<std::string, fs::path>& files) {
  if (!fs::is_directory(path)) {
    files["--" + name + "/" + path.filename().string()] = path;
    return;
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
    if (!entry.is_regular_file()) continue;
    files["--" + name + "/" + entry.path().lexically_relative(path).generic_string()] =
        entry.path();
  }
}

}  // namespace

OptionTexts ReadOptionTexts(const std::vector<const CLI::Option*>& options) {
  OptionTexts read;
  for (const CLI::Option* option : options) {
    const std::string name = NameOf(*option);
    if (std::find(kWithoutEffect.begin(), kWithoutEffect.end(), name) != kWithoutEffect.end()) {
      continue;
    }
    const std::string type = option->get_type_name();
    const bool names_files = type.starts_with("FILE") || type.starts_with("FOLDER");
    std::string value;
    for (const std::string& result : option->results()) {
      if (names_files) AddFiles(name, result, read.files);
      value += (value.empty() ? "" : ",") + result;
    }
    if (names_files) continue;
    read.values[name] = option->empty() ? option->get_default_str() : value;
  }
  return read;
}

}  // namespace groundglass
