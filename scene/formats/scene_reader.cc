// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/scene_reader.h"

#include "scene/face_number.h"
#include "scene/formats/ignore_mask.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/model_kind.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/same_picture.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/text_encoding.h"
#include "scene/formats/untagged.h"
#include "scene/formats/view_io.h"
#include "scene/shell_word.h"
#include "scene/text.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kModelExtensions = {
    ".osu", ".obj", ".ply", ".stl", ".glb", ".gltf"};
constexpr const char* kModelNames = "model.osu, .obj, .ply, .stl or .glb";

template <size_t N>
bool HasExtension(const fs::path& file, const std::array<std::string_view, N>& extensions) {
  const std::string extension = LowerCase(file.extension().string());
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

}  // namespace

std::vector<fs::path> ListFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored) && entry->path().filename().string().front() != '.') {
      files.push_back(entry->path());
    }
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

SceneReader::SceneReader(const fs::path& folder, const SceneOptions& options)
    : folder_(folder), options_(options) {
  result_.scene.folder = folder;
}

SceneReading SceneReader::Read(bool decode_pictures) {
  std::error_code error;
  if (!fs::is_directory(folder_, error)) {
    Fault(Error(folder_,
                fs::exists(folder_, error)
                    ? "a file, not a scene folder; expected the folder that holds the model, "
                      "images/ and views/"
                    : "no such scene folder")
              .what());
    return {std::move(result_), std::move(scene_faults_), {}};
  }
  ReadTheModel();
  TellWhatIsNotRead();
  const FilesByStem images = ListImages("images");
  ReadTags(images);
  ReadCalibration();
  Match(images);
  ShareMeasuredDistortion();
  SortTableFaults();
  TellWhatWasTaken();
  for (const char* subfolder : {"images", "views", "masks", "faces"}) {
    TellOddEntries(folder_ / subfolder);
  }
  AddMasks("masks", &Photograph::mask_file);
  AddMasks("faces", &Photograph::faces_file);
  if (decode_pictures) DecodeAll();
  std::vector<std::string> stray_faults = SetUnreadableApart();
  return {std::move(result_), std::move(scene_faults_), std::move(stray_faults)};
}

// What stands in images/ under a photograph's name and is no file; nothing if there is none.
std::optional<std::string> SceneReader::OtherThanAFile(const std::string& name) const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "images", error)) {
    if (entry.path().stem() != name || entry.is_regular_file(error)) continue;
    const std::string what = entry.is_symlink(error)     ? "a link that leads to no file"
                             : entry.is_directory(error) ? "a folder"
                                                         : "no file";
    return "images/" + entry.path().filename().string() + " is " + what +
           ": put the picture itself there";
  }
  return std::nullopt;
}

// The models of other names in the folder, and what to do with them; empty if there are none.
std::string SceneReader::OtherModels() const {
  for (const fs::path& file : ListFiles(folder_)) {
    const bool is_known = HasExtension(file, kModelExtensions) || file.extension() == ".mtl";
    if (file.stem() != "model" || is_known) continue;
    if (LowerCase(file.extension().string()) == ".gml") {
      return "; " + file.filename().string() + " is CityGML: groundglass convert " +
             ShellWord(file) + " " + ShellWord(folder_ / "model.osu") + " makes a model of it";
    }
    return "; " + file.filename().string() +
           " is of a kind that is not read: export it as one of these from the program that made "
           "it";
  }
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    if (entry.path().stem() != "model" || entry.exists(error)) continue;
    return "; " + entry.path().filename().string() +
           " is a link that leads to nothing: put the model itself there";
  }
  std::string list;
  for (const fs::path& file : ListFiles(folder_)) {
    if (!HasExtension(file, kModelExtensions)) continue;
    list += (list.empty() ? "" : ", ") + Quote(file.filename().string());
  }
  return list.empty() ? "" : "; there is " + list + ": rename it, or choose it with --model";
}

void SceneReader::ReadTheModel() {
  fs::path& file = result_.scene.model_file;
  if (options_.model_file) {
    file = *options_.model_file;
  } else {
    std::vector<fs::path> found;
    for (const fs::path& candidate : ListFiles(folder_)) {
      if (candidate.stem() == "model" && HasExtension(candidate, kModelExtensions)) {
        found.push_back(candidate);
      }
    }
    if (found.empty()) {
      Fault(Error(folder_, "no model; expected " + (kModelNames + OtherModels())).what());
      return;
    }
    if (found.size() > 1) {
      Fault(Error(folder_,
                  "two models, " + found[0].filename().string() + " and " +
                      found[1].filename().string() + "; keep one, or choose it with --model")
                .what());
      return;
    }
    file = found.front();
  }
  try {
    if (LowerCase(file.extension().string()) == ".osu" && fs::is_regular_file(file)) {
      CheckModelKind(file);
      const std::vector<std::string> faults = FindOsuFaults(ReadTextFile(file), file);
      for (const std::string& fault : faults) Fault(fault);
      if (!faults.empty()) return;
    }
    ModelReading reading = ReadModel(file, options_.model);
    result_.scene.model = std::move(reading.model);
    std::vector<std::string>& warnings = result_.scene.warnings;
    warnings.insert(warnings.end(), reading.warnings.begin(), reading.warnings.end());
  } catch (const Error& error) {
    Fault(error.what());
  }
}

void SceneReader::TellUntagged(const std::string& name,
                               const FilesByStem& images,
                               const std::map<std::string, fs::path>& image_of_tag) {
  const fs::path& image = images.at(name);
  result_.scene.untagged_images.push_back(image);
  const auto same = std::find_if(image_of_tag.begin(), image_of_tag.end(), [&](const auto& tagged) {
    return IsSamePicture(tagged.second, image);
  });
  // A copy that somebody left there wants no tag, but taking out.
  if (same != image_of_tag.end()) {
    Warn(image,
         "photograph without a tag; it is the very same picture as " +
             same->second.filename().string() +
             ", which has one: take it out, or put the picture here that was meant");
    return;
  }
  Warn(image, DescribeUntagged(name, folder_, options_.views));
}

void SceneReader::Match(const FilesByStem& images) {
  std::vector<std::string> tag_names;
  for (const auto& [name, file] : known_names_) tag_names.push_back(name);
  std::vector<PhotographName> image_names;
  for (const auto& [name, file] : images) {
    image_names.push_back({name, file.filename().string()});
  }
  // An image is a tag's by its name, even if another program writes it in another way.
  const std::vector<std::optional<size_t>> matches = MatchPhotographs(tag_names, image_names);
  std::map<std::string, fs::path> image_of_tag;
  std::vector<PhotographName> left;
  for (size_t i = 0; i < image_names.size(); ++i) {
    const auto tag = std::find(matches.begin(), matches.end(), i);
    const std::string& name = image_names[i].name;
    if (tag != matches.end()) {
      image_of_tag[tag_names[static_cast<size_t>(tag - matches.begin())]] = images.at(name);
      continue;
    }
    left.push_back(image_names[i]);
  }
  for (const PhotographName& image : left) TellUntagged(image.name, images, image_of_tag);
  for (const auto& [name, file] : known_names_) {
    if (image_of_tag.count(name) > 0) continue;
    if (const auto tag = tags_.find(name); tag != tags_.end() && tag->second.text) {
      for (const std::string& fault : FaultsOfText(name, tag->second, *tag->second.text)) {
        FaultOf(name, fault);
      }
    }
    Warn(file,
         "tag of " + name + " without a photograph; " +
             OtherThanAFile(name).value_or("expected images/" + name + " with " + kImageNames +
                                           NearestName(name, left)));
  }
  for (const auto& [name, place] : known_names_) {
    const auto image = image_of_tag.find(name);
    if (image == image_of_tag.end()) continue;
    const auto found = tags_.find(name);
    // Of a COLMAP model that has no camera for it, and says so.
    if (found == tags_.end() && faults_of_.count(name) == 0) continue;
    Photograph photograph;
    photograph.name = name;
    photograph.image_file = image->second;
    if (LowerCase(place.extension().string()) == ".view") photograph.view_file = place;
    try {
      photograph.size = ReadImageSize(image->second);
    } catch (const Error& error) {
      FaultOf(name, error.what());
      not_images_.insert(image->second);
    }
    if (found != tags_.end()) CompleteTag(found->second, photograph);
    try {
      const std::vector<std::string> warnings = InspectImage(image->second).warnings;
      result_.scene.warnings.insert(result_.scene.warnings.end(), warnings.begin(), warnings.end());
    } catch (const Error&) {
      // Reading its pixels says the same.
    }
    result_.scene.photographs.push_back(std::move(photograph));
  }
  if (result_.scene.photographs.empty() && result_.faults.empty()) {
    Fault(Error(folder_,
                std::string("no photograph has a tag; expected images/s5.jpg beside "
                            "views/s5.view. ") +
                    kHowToBegin)
              .what());
  }
}

void SceneReader::AddMasks(const char* subfolder, std::optional<fs::path> Photograph::*member) {
  std::vector<std::string> names;
  std::vector<fs::path> files;
  for (const auto& [name, file] : ListImages(subfolder)) {
    names.push_back(name);
    files.push_back(file);
  }
  std::vector<Photograph>& photographs = result_.scene.photographs;
  std::vector<std::optional<size_t>> matches = MatchPhotographs(names, NamesOf(photographs));
  std::vector<PhotographName> untagged;
  for (const fs::path& image : result_.scene.untagged_images) {
    untagged.push_back({image.stem().string(), image.filename().string()});
  }
  const std::vector<std::optional<size_t>> untagged_matches = MatchPhotographs(names, untagged);
  for (size_t i = 0; i < files.size(); ++i) {
    const fs::path& file = files[i];
    if (!matches[i]) matches[i] = FindByPlace(file.lexically_relative(folder_ / subfolder));
    if (!matches[i]) {
      if (untagged_matches[i]) {  // its photograph is warned of
        const fs::path& image = result_.scene.untagged_images[*untagged_matches[i]];
        if (member == &Photograph::mask_file) result_.scene.masks_of_untagged[image] = file;
        continue;
      }
      Warn(file, "mask without a photograph; expected images/" + names[i] + " with " + kImageNames);
      continue;
    }
    Photograph& photograph = photographs[*matches[i]];
    // Even one that is at fault is an input: whoever mends it wants the job done again.
    photograph.*member = file;
    try {
      const ImageSize size = ReadImageSize(file);
      // A picture that cannot be read has no size for a mask to fit.
      if (not_images_.count(photograph.image_file) > 0) continue;
      CheckMaskSize(file, size, photograph.size);
    } catch (const Error& error) {
      FaultOf(photograph.name, error.what());
      not_images_.insert(file);
    }
  }
}

std::optional<size_t> SceneReader::FindByPlace(const fs::path& mask) const {
  const std::vector<Photograph>& photographs = result_.scene.photographs;
  for (size_t i = 0; i < photographs.size(); ++i) {
    const std::string image = ImageName(result_.scene, photographs[i]);
    if (WithoutExtension(image) == WithoutExtension(mask.generic_string())) return i;
  }
  return std::nullopt;
}

void SceneReader::DecodeAll() {
  const std::vector<Photograph>& photographs = result_.scene.photographs;
  const PolygonModel& model = result_.scene.model;
  std::vector<std::vector<std::string>> faults(photographs.size());
  std::vector<std::string> unseen(photographs.size());
  tbb::parallel_for(size_t{0}, photographs.size(), [&](size_t i) {
    const auto attempt = [&](const fs::path& file, auto read) {
      if (not_images_.count(file) > 0) return;
      try {
        read();
      } catch (const Error& error) {
        faults[i].push_back(error.what());
      }
    };
    const Photograph& photograph = photographs[i];
    attempt(photograph.image_file, [&] {
      unseen[i] = WhyNothingIsSeen(ReadSrgb8(photograph.image_file), photograph.image_file);
    });
    if (photograph.mask_file) {
      attempt(*photograph.mask_file,
              [&] { ReadIgnoreMask(*photograph.mask_file, photograph.size); });
    }
    if (photograph.faces_file) {
      attempt(*photograph.faces_file, [&] {
        const Image16 numbers = ReadLabels(*photograph.faces_file);
        if (!model.faces.empty()) LabelsFromNumbers(model, numbers, *photograph.faces_file);
      });
    }
  });
  for (size_t i = 0; i < photographs.size(); ++i) {
    for (const std::string& line : faults[i]) FaultOf(photographs[i].name, line);
    if (!unseen[i].empty()) Warn(photographs[i].image_file, unseen[i]);
  }
  DecodeUntagged();
}

// Whoever is to write a tag for a picture should know first that it cannot be used.
void SceneReader::DecodeUntagged() {
  const std::vector<fs::path>& images = result_.scene.untagged_images;
  std::vector<std::string> faults(images.size());
  tbb::parallel_for(size_t{0}, images.size(), [&](size_t i) {
    try {
      ReadSrgb8(images[i]);
    } catch (const Error& error) {
      faults[i] = error.what();
    }
  });
  for (size_t i = 0; i < images.size(); ++i) {
    if (!faults[i].empty()) FaultOf(images[i].string(), faults[i]);
  }
}

std::vector<std::string> SceneReader::SetUnreadableApart() {
  Scene& scene = result_.scene;
  std::erase_if(scene.photographs, [&](Photograph& photograph) {
    const auto faults = faults_of_.find(photograph.name);
    if (faults == faults_of_.end()) return false;
    scene.unreadable.push_back({std::move(photograph), std::move(faults->second)});
    faults_of_.erase(faults);
    return true;
  });
  std::vector<std::string> stray_faults;
  for (const auto& [name, faults] : faults_of_) {
    stray_faults.insert(stray_faults.end(), faults.begin(), faults.end());
  }
  return stray_faults;
}

}  // namespace groundglass
