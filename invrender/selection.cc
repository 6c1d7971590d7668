// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/selection.h"

#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/csv.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/text_encoding.h"
#include "scene/text.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <string_view>

namespace groundglass {
namespace {

// "3-4" as a word processor writes it, with a dash or a minus.
std::string WithPlainDashes(std::string word) {
  for (const std::string_view dash : {"\xE2\x80\x93", "\xE2\x80\x94", "\xE2\x88\x92"}) {
    for (size_t at = word.find(dash); at != std::string::npos; at = word.find(dash)) {
      word.replace(at, dash.size(), "-");
    }
  }
  return word;
}

// The faces that one word means; none if it means nothing.
std::vector<int> FacesOfWord(const PolygonModel& model, const std::string& written) {
  std::string word = written;
  std::vector<int> found;
  for (size_t face = 0; face < model.faces.size(); ++face) {
    if (!word.empty() && model.faces[face].name == word) found.push_back(static_cast<int>(face));
  }
  if (!found.empty()) return found;
  word = WithPlainDashes(word);
  const size_t dash = word.find('-', 1);
  const auto first = ParseInteger(word.substr(0, dash));
  const auto last = dash == std::string::npos ? first : ParseInteger(word.substr(dash + 1));
  if (!first || !last || *first < 1 || *last < *first || *last > HighestFaceNumber(model)) {
    // A name as another program or keyboard writes it.
    const std::string folded = FoldedName(word);
    for (size_t face = 0; face < model.faces.size(); ++face) {
      if (!folded.empty() && FoldedName(model.faces[face].name) == folded) {
        found.push_back(static_cast<int>(face));
      }
    }
    return found;
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
  const size_t dash = word.find('-', 1);
  const auto first = ParseInteger(word.substr(0, dash));
  const auto last = dash == std::string::npos ? first : ParseInteger(word.substr(dash + 1));
  if (first && last && *last < *first && *last >= 1) {
    return "no face is called " + Quote(word) + ", and as a range it runs backwards: write " +
           std::to_string(*last) + "-" + std::to_string(*first);
  }
  const bool has_several = word.find_first_not_of("0123456789 ,;+-") == std::string::npos &&
                           word.find_first_of(" ,;+") != std::string::npos;
  return "no face is called " + Quote(word) +
         (has_several ? "; name one alone, or a range as 3-4, and others apart from it"
                      : "; faces have numbers from 1 to " +
                            std::to_string(HighestFaceNumber(model)) + ", and names");
}

// " s1 s2 s3", and how many more if there are many.
std::string ListNames(std::span<const PhotographName> names) {
  constexpr size_t kMost = 30;
  std::string all;
  for (size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    all += (i == 0 ? " " : ", ") + names[i].name;
  }
  if (names.size() > kMost) all += " and " + std::to_string(names.size() - kMost) + " more";
  return all;
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
  std::vector<char> is_excluded(photographs.size(), 0);
  for (const std::string& name : names) {
    const std::optional<size_t> found = FindPhotograph(name, NamesOf(photographs));
    if (!found) throw Error("no photograph to exclude is called " + Quote(name));
    is_excluded[*found] = 1;
  }
  size_t next = 0;
  std::erase_if(photographs, [&](const BakePhotograph&) { return is_excluded[next++] != 0; });
}

void UseMasks(const std::filesystem::path& folder, std::vector<BakePhotograph>& photographs) {
  std::vector<std::string> stems;
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& file : ListImageFiles(folder)) {
    stems.push_back(ImageStem(file));
    files.push_back(file);
  }
  for (size_t i = 1; i < stems.size(); ++i) {
    if (stems[i] == stems[i - 1])
      throw Error(files[i], "two masks have the stem " + Quote(stems[i]));
  }
  const std::vector<std::optional<size_t>> matches = MatchPhotographs(stems, NamesOf(photographs));
  bool is_any = false;
  for (size_t i = 0; i < files.size(); ++i) {
    if (!matches[i]) continue;
    photographs[*matches[i]].mask_file = files[i];
    is_any = true;
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

std::vector<std::string> RestrictToPairs(const std::filesystem::path& file,
                                         const PolygonModel& model,
                                         std::vector<BakePhotograph>& photographs,
                                         std::span<const PhotographName> known) {
  const CsvTable table(file);
  const std::vector<std::string>& header = table.header();
  const auto column = [&](const char* name) {
    return static_cast<size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const size_t image_column = column("image");
  const size_t face_column = column("face");
  if (image_column == header.size() || face_column == header.size()) {
    throw Error(file,
                std::max(1, table.header_line()),
                "expected the first line to name the columns: image,face");
  }
  const std::vector<PhotographName> names = NamesOf(photographs);
  std::map<int, std::set<size_t>> photographs_of_face;
  std::vector<std::string> faults;
  const auto leave_out = [&](const CsvRow& row, const std::string& why) {
    faults.push_back(Error(file, row.line, why + "; this line is left out").what());
  };
  for (const CsvRow& row : table.rows()) {
    const std::string& image = row.fields[image_column];
    const std::vector<int> faces = FacesOfWord(model, row.fields[face_column]);
    if (faces.empty()) {
      leave_out(row, NoSuchFace(model, row.fields[face_column]));
      continue;
    }
    std::optional<size_t> photograph;
    try {
      photograph = FindPhotograph(image, names);
      if (!photograph && !known.empty() && !FindPhotograph(image, known)) {
        throw Error("no photograph is called " + Quote(image) + NearestName(image, known) +
                    "; there are" + ListNames(known));
      }
    } catch (const Error& error) {
      leave_out(row, error.what());
      continue;
    }
    // One that is not textured from, after its verdict, still keeps others off its face.
    for (const int face : faces) {
      photographs_of_face[face];
      if (photograph) photographs_of_face[face].insert(*photograph);
    }
  }
  for (size_t i = 0; i < photographs.size(); ++i) {
    BakePhotograph& photograph = photographs[i];
    if (!photograph.faces) {
      photograph.faces.emplace(model.faces.size());
      std::iota(photograph.faces->begin(), photograph.faces->end(), 0);
    }
    std::erase_if(*photograph.faces, [&](int face) {
      const auto paired = photographs_of_face.find(face);
      return paired != photographs_of_face.end() && paired->second.count(i) == 0;
    });
  }
  return faults;
}

}  // namespace groundglass
