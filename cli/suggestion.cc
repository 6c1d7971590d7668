// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/suggestion.h"

#include "scene/nearest_word.h"

#include <algorithm>

namespace groundglass {
namespace {

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> OptionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string WholeName(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent ? WholeName(*parent) + " " : "") + command.get_name();
}

std::string Meant(const std::string& word, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = FindNearest(word, known);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

}  // namespace

const CLI::App& InnermostCommand(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : InnermostCommand(*parsed.back());
}

std::string WithHelp(const CLI::App& command, const std::string& message) {
  return WholeName(command) + ": " + message + " (" + WholeName(command) + " --help)";
}

std::string DescribeUsageError(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = InnermostCommand(app);
  std::string message = error.what();
  const std::vector<std::string> extras = command.remaining();
  const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& word) {
    return word.size() > 1 && word.front() == '-';
  });
  // Its name is the command's in this version of the library.
  const bool is_extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  if (option != extras.end()) {
    // Whatever else is wrong may come of it: "-o is required" after --ouput.
    const std::string name = option->substr(0, option->find('='));
    message = "there is no option " + name + Meant(name, OptionNames(command));
  } else if (is_extra && !extras.empty()) {
    message = "'" + extras.front() + "' is one word too many";
  }
  std::replace(message.begin(), message.end(), '\n', ' ');
  return WithHelp(command, message);
}

std::optional<std::string> FindUnknownCommand(const CLI::App& app,
                                              const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  for (const std::string& word : words) {
    const std::vector<std::string> known = CommandNames(*command);
    if (known.empty() || word == "--help" || word == "-h") return std::nullopt;
    if (word.empty() || word.front() == '-') continue;
    if (std::find(known.begin(), known.end(), word) == known.end()) {
      std::vector<std::string> candidates = known;
      if (command == &app) candidates.emplace_back("help");
      std::string list;
      for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
      return WholeName(*command) + ": there is no command '" + word + "'" +
             Meant(word, candidates) + " (there are " + list + ")";
    }
    command = command->get_subcommand(word);
  }
  return std::nullopt;
}

}  // namespace groundglass
