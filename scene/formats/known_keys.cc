// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/known_keys.h"

#include "scene/error.h"
#include "scene/formats/view_io.h"
#include "scene/formats/view_pairs.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace groundglass {
namespace {

// Numbers that are measured together, and the standard deviations that go with them.
struct KeyGroup {
  std::vector<std::string_view> numbers;
  std::vector<std::string_view> sigmas;
};

const std::vector<KeyGroup>& KeyGroups() {
  static const std::vector<KeyGroup> groups = {
      {{"x", "y", "z"}, {"sigma_position", "sigma_height"}},
      {{"i", "j", "k"}, {"sigma_lookat"}},
      {{"a"}, {"sigma_a"}},
      {{"v"}, {"sigma_v"}},
      {{"roll"}, {"sigma_roll"}},
      {{"shift_x", "shift_y"}, {"sigma_shift"}},
      {{"k1", "k2", "k3", "p1", "p2"}, {"sigma_k1"}},
      {{kCameraKey}, {}}};
  return groups;
}

KnownKeys KeysOfGroup(const KnownKeys& keys, const KeyGroup& group) {
  KnownKeys part;
  for (const std::vector<std::string_view>* names : {&group.numbers, &group.sigmas}) {
    for (const KnownKey& key : keys) {
      if (std::find(names->begin(), names->end(), key.key) != names->end()) part.push_back(key);
    }
  }
  return part;
}

// The first standard deviation among keys; infinite if there is none.
double SigmaAmong(const KnownKeys& keys) {
  for (const KnownKey& key : keys) {
    if (key.key.starts_with("sigma_")) return ParseNumber(key.value).value_or(HUGE_VAL);
  }
  return HUGE_VAL;
}

}  // namespace

void AddKnown(KnownKeys& keys, std::string_view key, double value, const std::string& comment) {
  keys.push_back({std::string(key), FormatNumber(value), comment});
}

KnownKeys ReadKnownKeys(const std::filesystem::path& file) {
  const std::string text = ReadTextFile(file);
  const ViewReading reading = ReadSomePairs(text, file);
  if (!reading.faults.empty()) throw Error(reading.faults.front());
  KnownKeys keys;
  for (const KeyValue& pair : reading.pairs) {
    const TextLine& line = reading.lines[static_cast<size_t>(pair.key.line) - 1];
    keys.push_back(
        {std::string(pair.key.text), std::string(pair.value.text), std::string(line.comment)});
  }
  return keys;
}

std::string FormatKnownKeys(const KnownKeys& keys, const std::string& comment) {
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text += "% " + line + "\n";
  for (const KnownKey& known : keys) {
    text += known.key + " " + known.value;
    if (!known.comment.empty()) text += "   % " + known.comment;
    text += "\n";
  }
  return text;
}

KnownKeys MergeKnownKeys(const KnownKeys& before, KnownKeys fresh, const std::string& source) {
  for (KnownKey& key : fresh) {
    key.comment = source + (key.comment.empty() ? "" : ": " + key.comment);
  }
  const std::string own_begin = source + ":";
  KnownKeys others = before;
  std::erase_if(others, [&](const KnownKey& key) {
    return key.comment == source || key.comment.starts_with(own_begin);
  });
  KnownKeys merged;
  for (const KeyGroup& group : KeyGroups()) {
    const KnownKeys own_part = KeysOfGroup(fresh, group);
    const KnownKeys other_part = KeysOfGroup(others, group);
    const bool takes_own = SigmaAmong(own_part) < SigmaAmong(other_part) || other_part.empty();
    const KnownKeys& taken = takes_own ? own_part : other_part;
    merged.insert(merged.end(), taken.begin(), taken.end());
  }
  return merged;
}

KnownKeys KeysLacking(const std::string& view_text, const KnownKeys& known) {
  const ViewReading reading = ReadSomePairs(view_text, "view");
  const auto has = [&](std::string_view key) { return FindPair(reading.pairs, key) != nullptr; };
  const auto find = [&](std::string_view key) {
    return std::find_if(
        known.begin(), known.end(), [&](const KnownKey& own) { return own.key == key; });
  };
  const auto knows = [&](std::string_view key) { return find(key) != known.end(); };
  KnownKeys lacking;
  for (const KeyGroup& group : KeyGroups()) {
    const bool takes_numbers = std::none_of(group.numbers.begin(), group.numbers.end(), has);
    const bool gives_numbers = std::any_of(group.numbers.begin(), group.numbers.end(), knows);
    if (gives_numbers && !takes_numbers) continue;
    for (const std::vector<std::string_view>* keys : {&group.numbers, &group.sigmas}) {
      for (const std::string_view key : *keys) {
        if (knows(key) && !has(key)) lacking.push_back(*find(key));
      }
    }
  }
  return lacking;
}

std::string WithKeys(std::string view_text, const KnownKeys& keys) {
  for (const KnownKey& known : keys) view_text += "\n" + known.key + " " + known.value;
  return view_text;
}

std::string NamesOf(const KnownKeys& keys) {
  std::string names;
  for (const KnownKey& known : keys) {
    if (!known.key.starts_with("sigma_")) names += (names.empty() ? "" : " ") + known.key;
  }
  return names;
}

}  // namespace groundglass
