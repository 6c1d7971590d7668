// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/obj_io.h"

#include "scene/error.h"
#include "scene/model_sigma.h"
#include "scene/text.h"
#include "scene/view_io.h"

#include <cmath>
#include <optional>

namespace groundglass {
namespace {

// The rest of the line after its first word, blanks inside kept.
std::string RestOfLine(const TextLine& line) {
  if (line.tokens.size() < 2) return "";
  const TextToken& last = line.tokens.back();
  const TextToken& first = line.tokens[1];
  return std::string(first.text.data(),
                     static_cast<size_t>(last.text.data() + last.text.size() - first.text.data()));
}

double ReadCoordinate(const std::filesystem::path& file, const TextLine& line, size_t index) {
  if (index >= line.tokens.size()) {
    throw Error(file, line.number, "expected " + std::to_string(index) + " numbers at least");
  }
  const std::optional<double> value = ParseNumber(line.tokens[index].text);
  if (!value || !std::isfinite(*value)) {
    throw Error(file, line.number, Quote(line.tokens[index].text) + " is not a finite number");
  }
  return *value;
}

// One field of "7/3/1": counts from 1, or backwards from the last with a minus.
int ReadIndex(const std::filesystem::path& file,
              const TextLine& line,
              std::string_view word,
              size_t count,
              const std::string& what) {
  const std::optional<long long> number = ParseInteger(word);
  if (!number) {
    throw Error(file, line.number, Quote(word) + " is not the number of a " + what);
  }
  const long long size = static_cast<long long>(count);
  const long long index = *number < 0 && *number >= -size ? size + *number : *number - 1;
  if (index < 0 || index >= size) {
    throw Error(file,
                line.number,
                what + " " + std::string(word) + " is outside 1 to " + std::to_string(count));
  }
  return static_cast<int>(index);
}

void ReadFaceLine(const std::filesystem::path& file, const TextLine& line, ObjReading& reading) {
  Face& face = reading.model.faces.emplace_back();
  std::vector<int>& texture_points = reading.face_texture_points.emplace_back();
  reading.face_lines.push_back(line.number);
  for (size_t i = 1; i < line.tokens.size(); ++i) {
    const std::string_view word = line.tokens[i].text;
    const size_t slash = word.find('/');
    face.points.push_back(ReadIndex(
        file, line, word.substr(0, slash), reading.model.points_in_world.size(), "point"));
    if (slash == std::string_view::npos) continue;
    const std::string_view rest = word.substr(slash + 1);
    const std::string_view texture_word = rest.substr(0, rest.find('/'));
    if (texture_word.empty()) continue;
    texture_points.push_back(
        ReadIndex(file, line, texture_word, reading.texture_points.size(), "texture point"));
  }
  // Texture points on some corners only say nothing about the face.
  if (texture_points.size() != face.points.size()) texture_points.clear();
}

}  // namespace

std::string ObjGroupName(std::string name) {
  for (char& c : name) {
    if (c == '#' || c == '\n' || c == '\r') c = ' ';
  }
  return name.empty() ? "default" : name;
}

ObjReading ReadObj(const std::filesystem::path& file) {
  ObjReading reading;
  const std::string text = ReadTextFile(file);
  std::string name;
  std::string material;
  constexpr std::string_view kSigmaKey = "sigma:";
  const TextLine* sigma_line = nullptr;  // read last: it is in the model's unit
  const std::vector<TextLine> lines = SplitLines(text, '#');
  for (const TextLine& line : lines) {
    if (line.has_comment && LowerCase(line.comment.substr(0, 5)) == "unit:") {
      const auto unit = FindUnit(TrimBlanks(line.comment.substr(5)));
      if (unit) reading.unit = unit;
    }
    if (line.has_comment && LowerCase(line.comment.substr(0, kSigmaKey.size())) == kSigmaKey) {
      sigma_line = &line;
    }
    if (line.tokens.empty()) continue;
    const std::string_view keyword = line.tokens.front().text;
    if (keyword == "v") {
      const double x = ReadCoordinate(file, line, 1);
      const double y = ReadCoordinate(file, line, 2);
      const double z = ReadCoordinate(file, line, 3);
      reading.model.points_in_world.emplace_back(x, y, z);
    } else if (keyword == "vt") {
      const double u = ReadCoordinate(file, line, 1);
      const double v = line.tokens.size() > 2 ? ReadCoordinate(file, line, 2) : 0.0;
      reading.texture_points.emplace_back(u, v);
    } else if (keyword == "f") {
      ReadFaceLine(file, line, reading);
      reading.model.faces.back().name = name;
      reading.materials.push_back(material);
    } else if (keyword == "g" || keyword == "o") {
      name = RestOfLine(line);
      if (name == "default") name.clear();
    } else if (keyword == "usemtl") {
      material = RestOfLine(line);
    } else if (keyword == "mtllib") {
      reading.libraries.push_back(RestOfLine(line));
    }
    // Normals, smoothing groups, lines and curves tell nothing that is used here.
  }
  if (sigma_line) {
    if (reading.unit) reading.model.unit = *reading.unit;
    ReadSigmaComment(
        sigma_line->comment.substr(kSigmaKey.size()), file, sigma_line->number, reading.model);
  }
  return reading;
}

}  // namespace groundglass
