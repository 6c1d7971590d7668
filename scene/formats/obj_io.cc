// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/obj_io.h"

#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/bad_corners.h"
#include "scene/formats/continued_lines.h"
#include "scene/formats/mesh_io.h"
#include "scene/formats/view_io.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <cmath>
#include <limits>
#include <map>
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
    // It is in the model's unit, which may be told further down.
    if (sigma_) ReadSigmaComment(*sigma_, file_, sigma_line_, reading_.model);
    ApplyFaceNumbers(face_numbers_, reading_.model);
    LeaveOutBadFaces();
    if (num_free_forms_ > 0) {
      reading_.warnings.push_back(
          Error(file_,
                std::to_string(num_free_forms_) +
                    " free-form curves and surfaces are left out; export them as polygons to have "
                    "them in the model")
              .what());
    }
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
    auto word = field("unit:");
    if (!word) word = field("file units =");  // as SketchUp writes
    if (!word) word = field("units:");
    if (word) {
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
      const double x = ReadNumber(words, 0, 3);
      const double y = ReadNumber(words, 1, 3);
      const double z = ReadNumber(words, 2, 3);
      reading_.model.points_in_world.emplace_back(OrNoPlace(x), OrNoPlace(y), OrNoPlace(z));
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
    if (keyword == "curv" || keyword == "curv2" || keyword == "surf") ++num_free_forms_;
    // Normals, smoothing groups and lines tell nothing that is used here.
  }

  double ReadCoordinate(const std::vector<std::string_view>& words, size_t index, int least) const {
    const double value = ReadNumber(words, index, least);
    if (!std::isfinite(value)) Fail(WhyNoNumber(words[index]));
    return value;
  }

  double ReadNumber(const std::vector<std::string_view>& words, size_t index, int least) const {
    if (index >= words.size()) {
      Fail("expected " + std::to_string(least) + (least == 1 ? " number" : " numbers") +
           " at least");
    }
    const std::optional<double> value = ParseNumber(words[index]);
    if (!value) Fail(WhyNoNumber(words[index]));
    return *value;
  }

  // One field of "7/3/1" as a place from 0: counts from 1, or backwards from the last with a minus;
  // -1 if it is none. Points may still follow, so that places beyond the last are judged at the
  // end.
  static int ReadIndex(std::string_view word, size_t count) {
    const std::optional<long long> number = ParseInteger(word);
    const auto size = static_cast<long long>(count);
    if (!number || *number < -size || *number > std::numeric_limits<int>::max()) return -1;
    // 0 is no point's number.
    return static_cast<int>(*number < 0 ? size + *number : *number - 1);
  }

  void ReadFaceLine() {
    Face& face = reading_.model.faces.emplace_back();
    face.number = static_cast<int>(reading_.model.faces.size());
    face.name = name_;
    std::vector<int>& texture_points = reading_.face_texture_points.emplace_back();
    reading_.face_lines.push_back(lines_.number());
    reading_.materials.push_back(material_);
    const int place = static_cast<int>(reading_.model.faces.size()) - 1;
    for (const std::string_view word : lines_.arguments()) {
      const size_t slash = word.find('/');
      const std::string_view point = word.substr(0, slash);
      face.points.push_back(ReadIndex(point, reading_.model.points_in_world.size()));
      if (face.points.back() < 0) bad_words_.try_emplace(place, point);
      if (slash == std::string_view::npos) continue;
      const std::string_view rest = word.substr(slash + 1);
      const std::string_view texture_word = rest.substr(0, rest.find('/'));
      if (texture_word.empty()) continue;
      texture_points.push_back(ReadIndex(texture_word, reading_.texture_points.size()));
      if (texture_points.back() < 0) bad_texture_words_.try_emplace(place, texture_word);
    }
    // Texture points on some corners only say nothing about the face.
    if (texture_points.size() != face.points.size()) texture_points.clear();
  }

  // What is wrong with a face's indices; empty if nothing is. `words`: of faces with one that is
  // negative here.
  static std::string FaultOfIndices(const std::vector<int>& indices,
                                    int face,
                                    const std::map<int, std::string>& words,
                                    size_t count,
                                    const std::string& what) {
    const std::string range = " is outside 1 to " + std::to_string(count);
    for (const int index : indices) {
      if (index >= 0 && static_cast<size_t>(index) < count) continue;
      if (index >= 0) return what + " " + std::to_string(index + 1) + range;
      const std::string& word = words.at(face);
      const std::optional<long long> number = ParseInteger(word);
      if (!number) {
        return Quote(word) + " is not the number of a " + what + "; there are " +
               std::to_string(count);
      }
      if (*number >= 0) return what + " " + word + range;
      return what + " " + word + " counts back beyond the first; there are " +
             std::to_string(count);
    }
    return "";
  }

  void LeaveOutBadFaces() {
    std::vector<BadCorner> bad;
    std::vector<BadCorner> grey;
    const PolygonModel& model = reading_.model;
    std::vector<std::vector<int>>& texture_points = reading_.face_texture_points;
    for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
      std::string fault = FaultOfIndices(
          model.faces[face].points, face, bad_words_, model.points_in_world.size(), "point");
      if (!fault.empty()) {
        bad.push_back({face, std::move(fault)});
        continue;
      }
      fault = FaultOfIndices(texture_points[face],
                             face,
                             bad_texture_words_,
                             reading_.texture_points.size(),
                             "texture point");
      if (fault.empty()) continue;
      texture_points[face].clear();
      grey.push_back({face, std::move(fault)});
    }
    if (!grey.empty()) {
      const int line = reading_.face_lines[static_cast<size_t>(grey[0].face)];
      const std::string which =
          grey.size() == 1 ? DescribeFace(model, grey[0].face) + " is without its picture: "
                           : std::to_string(grey.size()) +
                                 " faces are without their picture; "
                                 "the first: " +
                                 DescribeFace(model, grey[0].face) + ": ";
      reading_.warnings.push_back(Error(file_, line, which + grey[0].text).what());
    }
    if (bad.empty()) return;
    reading_.warnings.push_back(WarnOfBadCorners(file_, reading_.face_lines, model, bad));
    for (const BadCorner& corner : bad) reading_.left_out.push_back(corner.face + 1);
    DropFaces(bad, reading_.model.faces);
    DropFaces(bad, reading_.face_lines);
    DropFaces(bad, reading_.materials);
    DropFaces(bad, texture_points);
  }

  const std::filesystem::path& file_;
  ContinuedLines lines_;
  std::string name_;
  std::string material_;
  std::string face_numbers_;
  std::optional<std::string> sigma_;
  int sigma_line_ = 0;
  int num_free_forms_ = 0;
  // Of faces, by place, the first word that can be no index.
  std::map<int, std::string> bad_words_;
  std::map<int, std::string> bad_texture_words_;
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
