// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <vector>

namespace groundglass {

// What options are set to, for manifest.json and for telling whether what was made with them can be
// kept. Taken from the parser, so that an option that is added anywhere counts at once. Those that
// change no output (progress, threads, where to write) are left out.
struct OptionValues {
  std::map<std::string, std::string> values;  // by long name; lists with commas between
  // Options of type FILE or FOLDER count by what is in the files: "--lens/nikon.lens" and its hash.
  std::map<std::string, std::string> sha256_of_files;
};
OptionValues ReadOptionValues(const std::vector<const CLI::Option*>& options);

// The options that `add` gives to the command.
template <typename Add>
std::vector<const CLI::Option*> OptionsAddedBy(CLI::App* command, const Add& add) {
  const size_t first = command->get_options().size();
  add();
  const std::vector<CLI::Option*> all = command->get_options();
  return {all.begin() + static_cast<std::ptrdiff_t>(first), all.end()};
}

}  // namespace groundglass
