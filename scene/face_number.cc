// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/face_number.h"

#include "scene/error.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

// The face of each number that a label picture can hold, as a label; 0 where there is none.
std::vector<uint16_t> LabelOfNumber(const PolygonModel& model) {
  std::vector<uint16_t> label(65536, 0);
  for (size_t face = 0; face < model.faces.size() && face < 65535; ++face) {
    const int number = FaceNumber(model, static_cast<int>(face));
    if (number > 0 && number < 65536) label[number] = static_cast<uint16_t>(face + 1);
  }
  return label;
}

}  // namespace

std::optional<int> FindFaceByNumber(const PolygonModel& model, long long number) {
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    if (FaceNumber(model, face) == number) return face;
  }
  return std::nullopt;
}

int HighestFaceNumber(const PolygonModel& model) {
  int highest = 0;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    highest = std::max(highest, FaceNumber(model, face));
  }
  return highest;
}

Image16 NumbersFromLabels(const PolygonModel& model, const Image16& labels) {
  Image16 numbers = labels;
  for (uint16_t& value : numbers.values) {
    if (value > 0 && value <= model.faces.size()) {
      value = static_cast<uint16_t>(FaceNumber(model, value - 1));
    }
  }
  return numbers;
}

Image16 LabelsFromNumbers(const PolygonModel& model,
                          const Image16& numbers,
                          const std::filesystem::path& file) {
  const std::vector<uint16_t> label = LabelOfNumber(model);
  Image16 labels = numbers;
  for (uint16_t& value : labels.values) {
    if (value == 0) continue;
    if (label[value] == 0) {
      throw Error(file,
                  "names face " + std::to_string(value) +
                      (value > HighestFaceNumber(model)
                           ? ", but the model has " + std::to_string(HighestFaceNumber(model))
                           : ", which is left out of the model"));
    }
    value = label[value];
  }
  return labels;
}

Image16 KnownLabelsFromNumbers(const PolygonModel& model, const Image16& numbers) {
  const std::vector<uint16_t> label = LabelOfNumber(model);
  Image16 labels = numbers;
  for (uint16_t& value : labels.values) {
    if (value != 0) value = label[value] != 0 ? label[value] : uint16_t{65535};
  }
  return labels;
}

std::string FormatFaceNumbers(const PolygonModel& model) {
  std::string text;
  bool is_plain = true;
  const int num_faces = static_cast<int>(model.faces.size());
  for (int face = 0; face < num_faces;) {
    const int first = FaceNumber(model, face);
    is_plain = is_plain && first == face + 1;
    int last = first;
    while (++face < num_faces && FaceNumber(model, face) == last + 1) ++last;
    if (!text.empty()) text += ' ';
    text += std::to_string(first);
    if (last > first) text.append(1, '-').append(std::to_string(last));
  }
  return is_plain ? "" : text;
}

void ApplyFaceNumbers(std::string_view text, PolygonModel& model) {
  std::vector<int> numbers;
  for (const TextLine& line : SplitLines(text, '\0')) {
    for (const TextToken& token : line.tokens) {
      const size_t dash = token.text.find('-');
      const auto first = ParseInteger(token.text.substr(0, dash));
      const auto last =
          dash == std::string_view::npos ? first : ParseInteger(token.text.substr(dash + 1));
      if (!first || !last || *first < 1 || *last < *first) return;
      if (*last - *first >= static_cast<long long>(model.faces.size())) return;
      if (*last > 2000000000) return;
      for (long long number = *first; number <= *last; ++number) {
        numbers.push_back(static_cast<int>(number));
      }
      if (numbers.size() > model.faces.size()) return;
    }
  }
  if (numbers.size() != model.faces.size()) return;
  for (size_t face = 0; face < numbers.size(); ++face) model.faces[face].number = numbers[face];
}

std::string NameOfFace(const PolygonModel& model, int face) {
  const std::string& name = model.faces[face].name;
  std::string number = "face " + std::to_string(FaceNumber(model, face));
  if (name.empty()) return number;
  const auto num_alike = std::count_if(model.faces.begin(),
                                       model.faces.end(),
                                       [&](const auto& other) { return other.name == name; });
  return num_alike == 1 ? name : name + " (" + number + ")";
}

}  // namespace groundglass
