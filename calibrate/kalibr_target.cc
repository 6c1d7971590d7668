// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/board.h"
#include "scene/error.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <cmath>
#include <map>

namespace groundglass {

Board ReadKalibrTarget(const std::filesystem::path& file) {
  const std::string text = ReadTextFile(file);
  struct Value {
    std::string text;
    int line = 0;
  };
  std::map<std::string, Value> values;
  for (const TextLine& line : SplitLines(text, '#')) {
    std::string_view content = std::string_view(text).substr(line.offset, line.size);
    content = content.substr(0, content.find('#'));
    const size_t colon = content.find(':');
    if (colon == std::string_view::npos) continue;
    std::string value(TrimBlanks(content.substr(colon + 1)));
    std::erase_if(value, [](char c) { return c == '\'' || c == '"'; });
    values[LowerCase(TrimBlanks(content.substr(0, colon)))] = {value, line.number};
  }
  const std::string type = LowerCase(values["target_type"].text);
  if (type != "aprilgrid") {
    throw Error(file,
                "expected Kalibr's target_type: 'aprilgrid'" +
                    (type.empty() ? "" : ", not " + Quote(type)) +
                    "; only boards of AprilTags are read");
  }
  const auto number = [&](const std::string& key) {
    const Value& value = values[LowerCase(key)];
    if (value.line == 0) throw Error(file, "key " + Quote(key) + " is missing");
    const std::optional<double> found = ParseNumber(value.text);
    if (found && std::isfinite(*found) && *found > 0) return *found;
    throw Error(file,
                value.line,
                "key " + Quote(key) + ": " + Quote(value.text) + " is not a number above 0");
  };
  Board board;
  board.columns = static_cast<int>(std::min(number("tagCols"), 1000.0));
  board.rows = static_cast<int>(std::min(number("tagRows"), 1000.0));
  board.april_tag_size = number("tagSize");
  board.gap = number("tagSpacing") * board.april_tag_size;
  const Value& offset = values["codeoffset"];
  if (offset.line != 0 && offset.text != "0") {
    board.first_id = static_cast<int>(std::min(number("codeOffset"), 1e6));
  }
  try {
    board.Check();
  } catch (const Error& error) {
    throw Error(file, error.what());
  }
  return board;
}

}  // namespace groundglass
