// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/given_cameras.h"
#include "scene/formats/scene_reader.h"
#include "scene/formats/tags_csv.h"
#include "scene/formats/view_io.h"
#include "scene/formats/view_pairs.h"

#include <algorithm>

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
  if (options_.views) tags_place_ = "a .view file in " + options_.views->string();
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
  } else if (!fs::is_directory(folder_ / "calibration", error)) {
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
      const std::string text = ReadTextFile(file);
      known_names_[name] = file;
      const std::vector<std::string> faults = ReadSomePairs(text, file).faults;
      for (const std::string& fault : faults) FaultOf(name, fault);
      if (faults.empty()) tags_[name] = {{}, file, text};
    } catch (const Error& read_error) {
      known_names_[name] = file;
      FaultOf(name, read_error.what());
    }
  }
}

void SceneReader::ReadTable(const fs::path& table, const FilesByStem& images) {
  tags_place_ = "a row in tags.csv";
  try {
    const TagTable rows = ReadTagTable(table, result_.scene.model);
    for (const std::string& fault : rows.faults) Fault(fault);
    std::vector<std::string>& warnings = result_.scene.warnings;
    warnings.insert(warnings.end(), rows.warnings.begin(), rows.warnings.end());
    for (const TagRow& row : rows.rows) {
      tags_[row.name] = {row.tag, {}, {}};
      if (!row.text.empty()) tags_[row.name].text = row.text;
      known_names_[row.name] = table;
    }
    for (const auto& [name, faults] : rows.row_faults) {
      for (const std::string& fault : faults) FaultOf(name, fault);
      known_names_[name] = table;
    }
    if (!rows.faults.empty()) {
      // A table that cannot be read may have any photograph: do not call them untagged.
      for (const auto& [name, file] : images) known_names_.emplace(name, table);
    }
  } catch (const Error& read_error) {
    Fault(read_error.what());
  }
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
      tags_[names[index]] = {TagForModel(fitted.camera, result_.scene.model), {}, {}};
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
    Fault(Error(files.images_file, "no photograph in images/ has the name of any of its images")
              .what());
  }
}

}  // namespace groundglass
