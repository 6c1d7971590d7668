// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/selection.h"

#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/text.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

namespace groundglass {
namespace {

// The faces that one word means; none if it means nothing.
std::vector<int> FacesOfWord(const PolygonModel& model, const std::string& word) {
  std::vector<int> found;
  for (size_t face = 0; face < model.faces.size(); ++face) {
    if (!word.empty() && model.faces[face].name == word) found.push_back(static_cast<int>(face));
  }
  if (!found.empty()) return found;
  const size_t dash = word.find('-', 1);
  const auto first = ParseInteger(word.substr(0, dash));
  const auto last = dash == std::string::npos ? first : ParseInteger(word.substr(dash + 1));
  if (!first || !last || *first < 1 || *last < *first || *last > HighestFaceNumber(model)) {
    return {};
  }
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const int number = FaceNumber(model, face);
    if (number >= *first && number <= *last) found.push_back(face);
  }
  return found;
}

std::string NoSuchFace(const PolygonModel& model, const std::string& word) {
  const auto number = ParseInteger(word);
  if (number && *number >= 1 && *number < HighestFaceNumber(model)) {
    return "face " + std::to_string(*number) +
           " cannot be used, or lies twice, and is left out of the model";
  }
  return "no face is called " + Quote(word) + "; faces have numbers from 1 to " +
         std::to_string(HighestFaceNumber(model)) + ", and names";
}

bool IsCalled(const BakePhotograph& photograph, const std::string& name) {
  return photograph.name == name || photograph.image_file.filename() == name;
}

}  // namespace

std::vector<int> FindFaces(const PolygonModel& model, const std::vector<std::string>& words) {
  std::set<int> faces;
  for (const std::string& word : words) {
    const std::vector<int> found = FacesOfWord(model, word);
    if (found.empty()) throw Error(NoSuchFace(model, word));
    faces.insert(found.begin(), found.end());
  }
  return {faces.begin(), faces.end()};
}

void ExcludePhotographs(const std::vector<std::string>& names,
                        std::vector<BakePhotograph>& photographs) {
  for (const std::string& name : names) {
    const size_t num_left = std::erase_if(
        photographs, [&](const BakePhotograph& photograph) { return IsCalled(photograph, name); });
    if (num_left == 0) throw Error("no photograph to exclude is called " + Quote(name));
  }
}

void UseMasks(const std::filesystem::path& folder, std::vector<BakePhotograph>& photographs) {
  bool is_any = false;
  for (BakePhotograph& photograph : photographs) {
    for (const char* extension : {".png", ".tif", ".tiff", ".jpg"}) {
      const std::filesystem::path file = folder / (photograph.name + extension);
      if (!std::filesystem::exists(file)) continue;
      photograph.mask_file = file;
      is_any = true;
      break;
    }
  }
  if (!is_any) throw Error(folder, "expected masks named after the photographs, as s5.png");
}

void RestrictToFaces(const PolygonModel& model,
                     const std::vector<int>& faces,
                     std::vector<BakePhotograph>& photographs) {
  std::vector<char> is_wanted(model.faces.size(), 0);
  for (const int face : faces) is_wanted.at(face) = 1;
  for (BakePhotograph& photograph : photographs) {
    if (!photograph.faces) photograph.faces = faces;
    std::erase_if(*photograph.faces, [&](int face) { return !is_wanted[face]; });
  }
}

void RestrictToPairs(const std::filesystem::path& file,
                     const PolygonModel& model,
                     std::vector<BakePhotograph>& photographs) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::map<int, std::set<std::string>> names_of_face;
  bool has_header = false;
  for (const TextLine& line : SplitLines(text)) {
    std::string_view row = std::string_view(text).substr(line.offset, line.size);
    row = TrimBlanks(row.substr(0, row.find('%')));
    if (row.empty()) continue;
    const std::string place = file.string() + ":" + std::to_string(line.number);
    const size_t comma = row.find(',');
    if (comma == std::string_view::npos) throw Error(place + ": expected image,face");
    const std::string image(TrimBlanks(row.substr(0, comma)));
    const std::string word(TrimBlanks(row.substr(comma + 1)));
    if (!has_header) {
      if (LowerCase(image) != "image" || LowerCase(word) != "face") {
        throw Error(place + ": expected the first line to be image,face");
      }
      has_header = true;
      continue;
    }
    const std::vector<int> faces = FacesOfWord(model, word);
    if (faces.empty()) throw Error(place + ": " + NoSuchFace(model, word));
    for (const int face : faces) names_of_face[face].insert(image);
  }
  for (BakePhotograph& photograph : photographs) {
    if (!photograph.faces) {
      photograph.faces.emplace(model.faces.size());
      std::iota(photograph.faces->begin(), photograph.faces->end(), 0);
    }
    std::erase_if(*photograph.faces, [&](int face) {
      const auto names = names_of_face.find(face);
      if (names == names_of_face.end()) return false;
      return std::none_of(names->second.begin(), names->second.end(), [&](const std::string& name) {
        return IsCalled(photograph, name);
      });
    });
  }
}

}  // namespace groundglass
