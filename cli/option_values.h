// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "pipeline/stage_keys.h"

#include <CLI/CLI.hpp>

#include <vector>

namespace groundglass {

// What options are set to. Taken from the parser, so that an option that is added anywhere counts
// at once. Values by long name; lists with commas between. Those that change no output (progress,
// threads, where to write) are left out. Of options of type FILE or FOLDER all the files.
OptionTexts ReadOptionTexts(const std::vector<const CLI::Option*>& options);

// The options that `add` gives to the command.
template <typename Add>
std::vector<const CLI::Option*> OptionsAddedBy(CLI::App* command, const Add& add) {
  const size_t first = command->get_options().size();
  add();
  const std::vector<CLI::Option*> all = command->get_options();
  return {all.begin() + static_cast<std::ptrdiff_t>(first), all.end()};
}

}  // namespace groundglass
