// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/given_cameras.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/scene_reader.h"
#include "scene/formats/tags_csv.h"
#include "scene/formats/view_io.h"
#include "scene/formats/view_pairs.h"
#include "scene/text.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCamerasExpected =
    "no cameras here; expected .view files named after the photographs, or a COLMAP model "
    "(cameras.txt and images.txt, or cameras.bin and images.bin; in sparse/0 too)";

// Where the .view files of a folder given in place of the scene's own lie: in it, or in its views/
// if it is an output folder.
fs::path FindViews(const fs::path& given) {
  for (const fs::path& folder : {given, given / "views"}) {
    for (const fs::path& file : ListFiles(folder)) {
      if (LowerCase(file.extension().string()) == ".view") return folder;
    }
  }
  return {};
}

}  // namespace

void SceneReader::ReadTags(const FilesByStem& images) {
  if (options_.views) {
    try {
      if (const std::optional<ColmapFiles> files = FindColmapModel(*options_.views)) {
        ReadGivenCameras(*files, images);
        return;
      }
    } catch (const Error& read_error) {
      Fault(read_error.what());
      return;
    }
  }
  const fs::path views = options_.views ? FindViews(*options_.views) : folder_ / "views";
  const fs::path table = folder_ / "tags.csv";
  std::error_code error;
  const bool has_table = !options_.views && fs::is_regular_file(table, error);
  if (fs::is_directory(views, error)) {
    if (has_table) Warn(table, "not read, since there is a folder views/");
    ReadViewFiles(views);
  } else if (has_table) {
    ReadTable(table, images);
  } else if (options_.views) {
    Fault(Error(*options_.views, kCamerasExpected).what());
  } else if (!fs::is_directory(folder_ / "calibration", error) && WhyNotRead("views").empty()) {
    Fault(Error(folder_,
                std::string("no tags; expected a folder views/ with .view files, or tags.csv. ") +
                    kHowToBegin)
              .what());
  }
}

void SceneReader::ReadViewFiles(const fs::path& views) {
  for (const fs::path& file : ListFiles(views)) {
    if (LowerCase(file.extension().string()) != ".view") {
      Warn(file, "not a view file; expected the extension .view");
      continue;
    }
    const std::string name = NameInUtf8(file, file.stem().string());
    try {
      const std::string text = ReadViewText(file);
      known_names_[name] = file;
      const std::vector<std::string> faults = ReadSomePairs(text, file).faults;
      for (const std::string& fault : faults) FaultOf(name, fault);
      if (faults.empty()) tags_[name] = {{}, file, text, 0};
    } catch (const Error& read_error) {
      known_names_[name] = file;
      FaultOf(name, read_error.what());
    }
  }
}

void SceneReader::ReadTable(const fs::path& table, const FilesByStem& images) {
  try {
    const TagTable rows = ReadTagTable(table, result_.scene.model);
    for (const std::string& fault : rows.faults) Fault(fault);
    result_.scene.tags_have_angles = rows.has_angles;
    std::vector<std::string>& warnings = result_.scene.warnings;
    warnings.insert(warnings.end(), rows.warnings.begin(), rows.warnings.end());
    for (const TagRow& row : rows.rows) {
      const FoundTag found{row.tag, {}, row.text, row.line};
      if (IsNoTag(row.name, images, found)) {
        warnings.push_back(Error(table,
                                 row.line,
                                 "left out: there is no photograph " + Quote(row.name) +
                                     ", and the line gives no place of a camera")
                               .what());
        continue;
      }
      tags_[row.name] = found;
      known_names_[row.name] = table;
    }
    for (const TagTable::RowFault& fault : rows.row_faults) {
      FaultOf(fault.name, fault.text);
      known_names_[fault.name] = table;
    }
    if (!rows.faults.empty()) {
      // A table that cannot be read may have any photograph: do not call them untagged.
      for (const auto& [name, file] : images) known_names_.emplace(name, table);
    }
  } catch (const Error& read_error) {
    Fault(read_error.what());
    for (const auto& [name, file] : images) known_names_.emplace(name, table);
  }
}

bool SceneReader::IsNoTag(const std::string& name,
                          const FilesByStem& images,
                          const FoundTag& found) const {
  if (!found.text) return false;
  const ViewReading reading = ReadSomePairs(*found.text, "");
  const bool has_place = FindPair(reading.pairs, "x") != nullptr &&
                         FindPair(reading.pairs, "y") != nullptr &&
                         FindPair(reading.pairs, "z") != nullptr;
  if (has_place) return false;
  std::vector<PhotographName> image_names;
  for (const auto& [image, file] : images) image_names.push_back({image, file.filename().string()});
  return !MatchPhotographs(std::vector<std::string>{name}, image_names)[0];
}

std::vector<std::string> SceneReader::FaultsOfText(const std::string& name,
                                                   const FoundTag& found,
                                                   const std::string& text) const {
  if (found.line == 0) return FindViewFaults(text, found.view_file);
  if (TrimBlanks(text).empty()) {
    return {Error(folder_ / "tags.csv",
                  found.line,
                  name + ": the line gives no number; expected x, y, z, i, j, k, a and v")
                .what()};
  }
  std::vector<std::string> faults;
  for (const std::string& fault : FindViewFaults(text, "")) {
    const std::string message = fault.substr(fault.find(": ") + 2);
    faults.push_back(Error(folder_ / "tags.csv", found.line, name + ": " + message).what());
  }
  return faults;
}

void SceneReader::SortTableFaults() {
  const std::string place = (folder_ / "tags.csv").string() + ":";
  std::vector<std::string*> slots;
  std::vector<std::pair<long long, std::string>> sorted;
  for (std::string& fault : result_.faults) {
    if (!fault.starts_with(place)) continue;
    const std::string_view rest = std::string_view(fault).substr(place.size());
    const std::optional<long long> line = ParseInteger(rest.substr(0, rest.find(':')));
    if (!line) continue;
    slots.push_back(&fault);
    sorted.emplace_back(*line, fault);
  }
  std::stable_sort(
      sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (size_t i = 0; i < slots.size(); ++i) *slots[i] = sorted[i].second;
}

void SceneReader::ReadGivenCameras(const ColmapFiles& files, const FilesByStem& images) {
  cameras_file_ = files.images_file;
  std::vector<std::string> names;
  std::vector<std::string> paths;
  for (const auto& [name, file] : images) {
    names.push_back(name);
    paths.push_back(file.lexically_relative(folder_ / "images").generic_string());
    known_names_[name] = files.images_file;
  }
  const GivenCameras given = MatchColmapModel(files, paths);
  result_.scene.camera_files = given.files;
  std::vector<std::string>& warnings = result_.scene.warnings;
  warnings.insert(warnings.end(), given.warnings.begin(), given.warnings.end());
  for (const std::string& fault : given.faults) Fault(fault);
  for (const auto& [index, faults] : given.faults_of_image) {
    for (const std::string& fault : faults) FaultOf(names[index], fault);
  }
  std::map<std::string, std::vector<std::string>> names_of_change;
  for (const auto& [index, camera] : given.camera_of_image) {
    const fs::path& image_file = images.at(names[index]);
    try {
      const FittedCamera fitted = FitCamera(camera.camera, ReadImageSize(image_file), image_file);
      tags_[names[index]] = {TagForModel(fitted.camera, result_.scene.model), {}, {}, 0};
      if (!fitted.change.empty()) names_of_change[fitted.change].push_back(names[index]);
    } catch (const Error& error) {
      FaultOf(names[index], error.what());
    }
  }
  for (const auto& [change, changed] : names_of_change) {
    std::string message = changed.size() == 1 ? "camera of " : "cameras of ";
    for (size_t i = 0; i < std::min<size_t>(3, changed.size()); ++i) {
      message += (i == 0 ? "" : ", ") + changed[i];
    }
    if (changed.size() > 3) message += " and " + std::to_string(changed.size() - 3) + " more";
    Warn(files.images_file, message + " " + change);
  }
  if (given.camera_of_image.empty() && given.faults_of_image.empty()) {
    std::string which;
    if (!given.strays.empty() && !paths.empty()) {
      which = ": its first is " + Quote(given.strays.front()) + ", and the first in images/ is " +
              Quote(paths.front()) + "; give both the same names";
    }
    Fault(Error(files.images_file,
                "no photograph in images/ has the name of any of its images" + which)
              .what());
  }
}

}  // namespace groundglass
