// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/suggestion.h"

#include "scene/nearest_word.h"
#include "scene/text.h"

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

// "a number", by what the option is to hold.
std::string ExpectedOf(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  const std::string type = option ? option->get_type_name() : std::string();
  if (type.starts_with("UINT")) return "a whole number, 0 or more";
  return type.starts_with("INT") ? "a whole number" : "a number";
}

// The library's messages of what was typed, as a person would say them.
std::string InPlainWords(const CLI::App& command, const std::string& message) {
  constexpr std::string_view kNotConverted = "Could not convert: ";
  constexpr std::string_view kNotMember = " not in {";
  constexpr std::string_view kNone = " required ";
  const size_t colon = message.find(": ");
  if (message.starts_with(kNotConverted)) {
    const size_t equals = message.find(" = ");
    if (equals == std::string::npos) return message;
    const std::string name = message.substr(kNotConverted.size(), equals - kNotConverted.size());
    return name + ": expected " + ExpectedOf(command, name) + ", not " +
           Quote(message.substr(equals + 3));
  }
  if (const size_t at = message.find(kNotMember);
      at != std::string::npos && colon < at && message.ends_with("}")) {
    const size_t list = at + kNotMember.size();
    std::string words = message.substr(list, message.size() - 1 - list);
    for (size_t comma = words.find(','); comma != std::string::npos;
         comma = words.find(',', comma + 2)) {
      words.replace(comma, 1, ", ");
    }
    return message.substr(0, colon + 2) + Quote(message.substr(colon + 2, at - colon - 2)) +
           " is none of " + words;
  }
  if (colon != std::string::npos && message.ends_with(" missing") &&
      message.find(kNone, colon) != std::string::npos) {
    return message.substr(0, colon) + ": its value is missing";
  }
  return message;
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
  std::string message = InPlainWords(command, error.what());
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
