// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/obj_io.h"

#include "scene/continued_lines.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/model_sigma.h"
#include "scene/text.h"
#include "scene/view_io.h"

#include <cmath>
#include <optional>

namespace groundglass {
namespace {

class ObjReader {
 public:
  ObjReader(const std::string& text, const std::filesystem::path& file)
      : file_(file), lines_(text) {}

  ObjReading Read() {
    reading_.model.is_unit_assumed = true;
    while (lines_.Next()) {
      if (lines_.text().empty()) continue;
      if (lines_.text().front() == '#') {
        ReadComment(TrimBlanks(lines_.text().substr(1)));
      } else {
        ReadLine(LowerCase(lines_.keyword()));
      }
    }
    ResolveIndices();
    // It is in the model's unit, which may be told further down.
    if (sigma_) ReadSigmaComment(*sigma_, file_, sigma_line_, reading_.model);
    ApplyFaceNumbers(face_numbers_, reading_.model);
    return std::move(reading_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(file_, lines_.number(), message);
  }

  void ReadComment(std::string_view comment) {
    const auto field = [&](std::string_view key) -> std::optional<std::string_view> {
      if (LowerCase(comment.substr(0, key.size())) != key) return std::nullopt;
      return TrimBlanks(comment.substr(key.size()));
    };
    if (const auto word = field("unit:")) {
      if (const auto unit = FindUnit(*word)) {
        reading_.model.unit = *unit;
        reading_.model.is_unit_assumed = false;
      }
    } else if (const auto numbers = field("face numbers:")) {
      face_numbers_ = std::string(*numbers);
    } else if (const auto sigma = field("sigma:")) {
      sigma_ = std::string(*sigma);
      sigma_line_ = lines_.number();
    }
  }

  void ReadLine(const std::string& keyword) {
    if (keyword == "v") {
      const std::vector<std::string_view> words = lines_.arguments();
      const double x = ReadCoordinate(words, 0, 3);
      const double y = ReadCoordinate(words, 1, 3);
      const double z = ReadCoordinate(words, 2, 3);
      reading_.model.points_in_world.emplace_back(x, y, z);
    } else if (keyword == "vt") {
      const std::vector<std::string_view> words = lines_.arguments();
      const double u = ReadCoordinate(words, 0, 1);
      const double v = words.size() > 1 ? ReadCoordinate(words, 1, 2) : 0.0;
      reading_.texture_points.emplace_back(u, v);
    } else if (keyword == "f" || keyword == "fo") {
      ReadFaceLine();
    } else if (keyword == "g" || keyword == "o") {
      name_ = lines_.rest();
      if (name_ == "default") name_.clear();
    } else if (keyword == "usemtl") {
      material_ = lines_.rest();
    } else if (keyword == "mtllib") {
      reading_.libraries.emplace_back(lines_.rest());
    }
    // Normals, smoothing groups, lines and curves tell nothing that is used here.
  }

  double ReadCoordinate(const std::vector<std::string_view>& words, size_t index, int least) const {
    if (index >= words.size()) {
      Fail("expected " + std::to_string(least) + (least == 1 ? " number" : " numbers") +
           " at least");
    }
    const std::optional<double> value = ParseNumber(words[index]);
    if (!value || !std::isfinite(*value)) Fail(Quote(words[index]) + " is not a finite number");
    return *value;
  }

  // One field of "7/3/1" as a place from 0: counts from 1, or backwards from the last with a minus.
  // Points may still follow, so that places beyond the last are judged at the end.
  int ReadIndex(std::string_view word, size_t count, const char* what) const {
    const std::optional<long long> number = ParseInteger(word);
    if (!number) Fail(Quote(word) + " is not the number of a " + what);
    const long long size = static_cast<long long>(count);
    const long long index = *number < 0 && *number >= -size ? size + *number : *number - 1;
    if (index < 0 || index > 2147483646) {
      Fail(std::string(what) + " " + std::string(word) + " is outside 1 to " +
           std::to_string(count));
    }
    return static_cast<int>(index);
  }

  void ReadFaceLine() {
    Face& face = reading_.model.faces.emplace_back();
    face.number = static_cast<int>(reading_.model.faces.size());
    face.name = name_;
    std::vector<int>& texture_points = reading_.face_texture_points.emplace_back();
    reading_.face_lines.push_back(lines_.number());
    reading_.materials.push_back(material_);
    for (const std::string_view word : lines_.arguments()) {
      const size_t slash = word.find('/');
      face.points.push_back(
          ReadIndex(word.substr(0, slash), reading_.model.points_in_world.size(), "point"));
      if (slash == std::string_view::npos) continue;
      const std::string_view rest = word.substr(slash + 1);
      const std::string_view texture_word = rest.substr(0, rest.find('/'));
      if (texture_word.empty()) continue;
      texture_points.push_back(
          ReadIndex(texture_word, reading_.texture_points.size(), "texture point"));
    }
    // Texture points on some corners only say nothing about the face.
    if (texture_points.size() != face.points.size()) texture_points.clear();
  }

  void ResolveIndices() const {
    const auto check = [&](int index, size_t count, size_t face, const char* what) {
      if (static_cast<size_t>(index) < count) return;
      throw Error(file_,
                  reading_.face_lines[face],
                  std::string(what) + " " + std::to_string(index + 1) + " is outside 1 to " +
                      std::to_string(count));
    };
    for (size_t face = 0; face < reading_.model.faces.size(); ++face) {
      for (const int point : reading_.model.faces[face].points) {
        check(point, reading_.model.points_in_world.size(), face, "point");
      }
      for (const int point : reading_.face_texture_points[face]) {
        check(point, reading_.texture_points.size(), face, "texture point");
      }
    }
  }

  const std::filesystem::path& file_;
  ContinuedLines lines_;
  std::string name_;
  std::string material_;
  std::string face_numbers_;
  std::optional<std::string> sigma_;
  int sigma_line_ = 0;
  ObjReading reading_;
};

}  // namespace

std::string ObjGroupName(std::string name) {
  for (char& c : name) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  // A backslash at the end would join the next line.
  while (!name.empty() && (name.back() == '\\' || name.back() == ' ')) name.pop_back();
  return name.empty() ? "default" : name;
}

std::string ObjModelComments(const PolygonModel& model) {
  std::string text = std::string("# unit: ") + UnitName(model.unit) + "\n";
  if (model.sigma) text += "# sigma: " + FormatNumber(*model.sigma) + "\n";
  const std::string numbers = FormatFaceNumbers(model);
  if (!numbers.empty()) text += "# face numbers: " + numbers + "\n";
  return text;
}

ObjReading ReadObj(const std::filesystem::path& file) {
  const std::string text = ReadTextFile(file);
  return ObjReader(text, file).Read();
}

}  // namespace groundglass
