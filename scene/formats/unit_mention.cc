// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/unit_mention.h"

#include "scene/error.h"
#include "scene/length_unit.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

namespace groundglass {
namespace {

// A comment that speaks of a unit in another way than "unit: m": "units = metres", "unit m", "all
// lengths in metres". Nothing if the comment speaks of none.
std::optional<LengthUnit> FindUnitMentioned(std::string_view comment) {
  std::string plain = LowerCase(comment);
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return std::strchr(":=.,;()[]", c); }, ' ');
  std::vector<std::string> words;
  for (const TextLine& line : SplitLines(plain)) {
    for (const TextToken& word : line.tokens) words.emplace_back(word.text);
  }
  // "in" and "m" are words of other meanings too.
  const bool begins_with_unit = words.size() == 2 && (words[0] == "unit" || words[0] == "units");
  if (begins_with_unit) return FindUnit(words[1]);
  for (size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i] != "in" || words[i + 1].size() < 2) continue;
    const std::optional<LengthUnit> unit = FindUnit(words[i + 1]);
    if (unit && (i + 2 == words.size())) return unit;
  }
  return std::nullopt;
}

}  // namespace

std::string UnitNotRead(const std::filesystem::path& name,
                        const std::vector<TextLine>& lines,
                        const PolygonModel& model) {
  if (!model.is_unit_assumed) return "";
  for (const TextLine& line : lines) {
    if (!line.tokens.empty()) return "";
    const auto unit = line.has_comment ? FindUnitMentioned(line.comment) : std::nullopt;
    if (!unit || *unit == model.unit) continue;
    return Error(name,
                 line.number,
                 "speaks of a unit in words that are not read, " + Quote(line.comment) +
                     "; if it is " + UnitName(*unit) + ", write '% unit: " + UnitName(*unit) + "'")
        .what();
  }
  return "";
}

}  // namespace groundglass
