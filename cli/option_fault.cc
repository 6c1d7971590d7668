// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/option_fault.h"

#include "cli/suggestion.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

// A field "texel_size" is filled by --texel-size; these have options of other names.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kOtherNames = {{
    {"april_tag_size", "tag-size"},
    {"max_page_texels", "max-texture"},
    {"max_memory_mb", "memory"},
    {"height_deg", "orbit-height"},
    {"frames_per_second", "fps"},
    {"num_trials", "trials"},
    {"num_blunders", "blunders"},
    {"width", "size"},
    {"height", "size"},
}};

const CLI::Option* FindOption(const CLI::App& command, std::string_view field) {
  std::string name(field);
  std::replace(name.begin(), name.end(), '_', '-');
  if (const CLI::Option* option = command.get_option_no_throw("--" + name)) return option;
  for (const auto& [of_struct, of_command] : kOtherNames) {
    if (of_struct != field) continue;
    return command.get_option_no_throw("--" + std::string(of_command));
  }
  return nullptr;
}

// "lock" and "free" of "options lock and free:", "width_cells" of "registration options:
// hypotheses.width_cells": the last part of each, without the structs that it is in.
std::vector<std::string> FieldNames(std::string field) {
  while (!field.empty() && field.back() == ':') field.pop_back();
  const size_t structs = field.rfind(": ");
  if (structs != std::string::npos) field = field.substr(structs + 2);
  std::vector<std::string> names;
  constexpr std::string_view kAnd = " and ";
  for (size_t at = 0; at <= field.size();) {
    const size_t end = std::min(field.find(kAnd, at), field.size());
    const std::string whole = field.substr(at, end - at);
    names.push_back(whole.substr(whole.find_last_of(" ./") + 1));
    at = end + kAnd.size();
  }
  return names;
}

}  // namespace

std::optional<std::string> DescribeOptionFault(const CLI::App& app, const OptionError& error) {
  const CLI::App& command = InnermostCommand(app);
  std::vector<std::string> typed;
  bool is_any_given = false;
  for (const std::string& field : FieldNames(error.field())) {
    const CLI::Option* option = FindOption(command, field);
    if (option == nullptr) return std::nullopt;
    is_any_given = is_any_given || option->count() > 0;
    const std::string name = "--" + option->get_lnames().back();
    if (std::find(typed.begin(), typed.end(), name) == typed.end()) typed.push_back(name);
  }
  if (!is_any_given) return std::nullopt;
  std::string names;
  for (const std::string& name : typed) names += (names.empty() ? "" : " and ") + name;
  return WithHelp(command, names + ": " + error.rule());
}

}  // namespace groundglass
