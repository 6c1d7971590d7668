// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/scene_folder.h"

#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/given_cameras.h"
#include "scene/ignore_mask.h"
#include "scene/image_kind.h"
#include "scene/image_paths.h"
#include "scene/photograph_name.h"
#include "scene/select_photographs.h"
#include "scene/tags_csv.h"
#include "scene/text.h"
#include "scene/text_encoding.h"
#include "scene/view_io.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kModelExtensions = {
    ".osu", ".obj", ".ply", ".stl", ".glb", ".gltf"};
constexpr const char* kModelNames = "model.osu, .obj, .ply, .stl or .glb";
// So many photographs' faults are told where none of them can be used.
constexpr size_t kMostReasons = 3;
constexpr const char* kCamerasExpected =
    "no cameras here; expected .view files named after the photographs, or a COLMAP model "
    "(cameras.txt and images.txt, or cameras.bin and images.bin; in sparse/0 too)";

// Said where no photograph has a tag.
constexpr const char* kHowToBegin =
    "A tag says where the camera stood (x y z), the point that it looked at (i j k), the frame's "
    "width / height (a) and its horizontal view angle in degrees (v): groundglass check SCENE "
    "--template writes one for each photograph, to be filled in; docs/tutorial.md tells how";

template <size_t N>
bool HasExtension(const fs::path& file, const std::array<std::string_view, N>& extensions) {
  const std::string extension = LowerCase(file.extension().string());
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

// The plain files of a folder in natural order, hidden ones left out; none if there is no folder.
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

struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const { return NaturalLess(a, b); }
};
using FilesByStem = std::map<std::string, fs::path, NaturalOrder>;

struct FoundTag {
  ViewTag tag;
  fs::path view_file;
};

// A scene and its faults, told apart by what they spoil.
struct SceneReading {
  SceneCheck check;                       // with every fault, in the order of reading
  std::vector<std::string> scene_faults;  // of the whole: nothing can be done with this scene
  std::vector<std::string> stray_faults;  // of files that no photograph needs
};

// Gathers a scene and its faults, part by part, each as far as it can be read.
class SceneReader {
 public:
  SceneReader(const fs::path& folder, const SceneOptions& options)
      : folder_(folder), options_(options) {
    result_.scene.folder = folder;
  }

  SceneReading Read() {
    std::error_code error;
    if (!fs::is_directory(folder_, error)) {
      Fault(Error(folder_, "no such scene folder").what());
      return {std::move(result_), std::move(scene_faults_), {}};
    }
    ReadTheModel();
    const FilesByStem images = ListImages("images");
    ReadTags(images);
    Match(images);
    AddMasks("masks", &Photograph::mask_file);
    AddMasks("faces", &Photograph::faces_file);
    DecodeAll();
    std::vector<std::string> stray_faults = SetUnreadableApart();
    return {std::move(result_), std::move(scene_faults_), std::move(stray_faults)};
  }

 private:
  // Of the scene as a whole.
  void Fault(const std::string& line) {
    result_.faults.push_back(line);
    scene_faults_.push_back(line);
  }
  // Of one photograph, its tag or its masks.
  void FaultOf(const std::string& name, const std::string& line) {
    result_.faults.push_back(line);
    faults_of_[name].push_back(line);
  }
  void Warn(const fs::path& file, const std::string& message) {
    result_.scene.warnings.push_back(Error(file, message).what());
  }

  void ReadTheModel() {
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
        Fault(Error(folder_, std::string("no model; expected ") + kModelNames).what());
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
    if (LowerCase(file.extension().string()) == ".osu" && fs::is_regular_file(file)) {
      const std::vector<std::string> faults = FindOsuFaults(ReadTextFile(file), file);
      for (const std::string& fault : faults) Fault(fault);
      if (!faults.empty()) return;
    }
    try {
      ModelReading reading = ReadModel(file, options_.model);
      result_.scene.model = std::move(reading.model);
      std::vector<std::string>& warnings = result_.scene.warnings;
      warnings.insert(warnings.end(), reading.warnings.begin(), reading.warnings.end());
    } catch (const Error& error) {
      Fault(error.what());
    }
  }

  // The images of a folder and of those in it, by the photographs' names (image_paths.h), and what
  // else lies there told once.
  FilesByStem ListImages(const char* subfolder) {
    const fs::path folder = folder_ / subfolder;
    std::vector<std::string> paths = ListFilesBelow(folder);
    std::erase_if(paths, [&](const std::string& path) {
      const ImageKind kind = FindImageKind(folder / path);
      if (kind.IsImage() || IsImageExtension(fs::path(path).extension().string())) return false;
      Warn(folder / path,
           "not an image that is read here, but " + kind.description + "; expected " + kImageNames +
               "; " + kind.remedy);
      return true;
    });
    const std::vector<std::string> names = NamePhotographs(paths);
    FilesByStem images;
    for (size_t i = 0; i < paths.size(); ++i) {
      const fs::path file = folder / paths[i];
      const auto [place, is_new] = images.emplace(NameInUtf8(file, names[i]), file);
      if (is_new) continue;
      // Cameras write both; the picture that is developed already is the better known one.
      const bool is_raw = FindImageKind(file).reader == "raw";
      if (is_raw != (FindImageKind(place->second).reader == "raw")) {
        const fs::path raw_file = is_raw ? file : place->second;
        if (!is_raw) place->second = file;
        Warn(raw_file,
             "camera raw file left out, since " + place->second.filename().string() +
                 " is there too");
        continue;
      }
      FaultOf(place->first,
              Error(file,
                    "two images have the stem " + Quote(place->first) + "; the other is " +
                        place->second.filename().string())
                  .what());
    }
    return images;
  }

  // A name from a file's, which old archives may have in Latin-1.
  std::string NameInUtf8(const fs::path& file, const std::string& name) {
    const Utf8Text utf8 = Utf8FromBytes(name);
    if (utf8.is_guessed) {
      Warn(file, "its name is not UTF-8; it is taken as " + Quote(utf8.text) + ", rename it");
    }
    return utf8.text;
  }

  void ReadTags(const FilesByStem& images) {
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
      for (const fs::path& file : ListFiles(views)) {
        if (LowerCase(file.extension().string()) != ".view") {
          Warn(file, "not a view file; expected the extension .view");
          continue;
        }
        const std::string name = NameInUtf8(file, file.stem().string());
        try {
          const std::string text = ReadTextFile(file);
          known_names_[name] = file;
          const std::vector<std::string> faults = FindViewFaults(text, file);
          for (const std::string& fault : faults) FaultOf(name, fault);
          if (faults.empty()) tags_[name] = {ParseView(text, file), file};
        } catch (const Error& read_error) {
          known_names_[name] = file;
          FaultOf(name, read_error.what());
        }
      }
    } else if (has_table) {
      tags_place_ = "a row in tags.csv";
      try {
        const TagTable rows = ReadTagTable(table, result_.scene.model);
        for (const std::string& fault : rows.faults) Fault(fault);
        std::vector<std::string>& warnings = result_.scene.warnings;
        warnings.insert(warnings.end(), rows.warnings.begin(), rows.warnings.end());
        for (const TagRow& row : rows.rows) {
          tags_[row.name] = {row.tag, {}};
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
    } else if (options_.views) {
      Fault(Error(*options_.views, kCamerasExpected).what());
    } else {
      Fault(Error(folder_,
                  std::string("no tags; expected a folder views/ with .view files, or tags.csv. ") +
                      kHowToBegin)
                .what());
    }
  }

  // The tags of a COLMAP model's cameras.
  void ReadGivenCameras(const ColmapFiles& files, const FilesByStem& images) {
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
    std::map<std::string, std::vector<std::string>> names_of_change;
    for (const auto& [index, camera] : given.camera_of_image) {
      const fs::path& image_file = images.at(names[index]);
      try {
        const FittedCamera fitted = FitCamera(camera.camera, ReadImageSize(image_file), image_file);
        tags_[names[index]] = {TagForModel(fitted.camera, result_.scene.model), {}};
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
    if (given.camera_of_image.empty()) {
      Fault(Error(files.images_file, "no photograph in images/ has the name of any of its images")
                .what());
    }
  }

  void Match(const FilesByStem& images) {
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
      const std::string expected =
          tags_place_.empty() ? "views/" + name + ".view" : tags_place_ + " for " + name;
      result_.scene.untagged_images.push_back(images.at(name));
      Warn(images.at(name), "photograph without a tag; expected " + expected);
    }
    for (const auto& [name, file] : known_names_) {
      if (image_of_tag.count(name) > 0) continue;
      Warn(file,
           "tag of " + name + " without a photograph; expected images/" + name + " with " +
               kImageNames + NearestName(name, left));
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
      if (found != tags_.end()) photograph.tag = found->second.tag;
      try {
        photograph.size = ReadImageSize(image->second);
      } catch (const Error& error) {
        FaultOf(name, error.what());
        not_images_.insert(image->second);
      }
      try {
        const std::vector<std::string> warnings = InspectImage(image->second).warnings;
        result_.scene.warnings.insert(
            result_.scene.warnings.end(), warnings.begin(), warnings.end());
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

  void AddMasks(const char* subfolder, std::optional<fs::path> Photograph::*member) {
    std::vector<std::string> names;
    std::vector<fs::path> files;
    for (const auto& [name, file] : ListImages(subfolder)) {
      names.push_back(name);
      files.push_back(file);
    }
    std::vector<Photograph>& photographs = result_.scene.photographs;
    std::vector<std::optional<size_t>> matches = MatchPhotographs(names, NamesOf(photographs));
    for (size_t i = 0; i < files.size(); ++i) {
      const fs::path& file = files[i];
      if (!matches[i]) matches[i] = FindByPlace(file.lexically_relative(folder_ / subfolder));
      if (!matches[i]) {
        Warn(file,
             "mask without a photograph; expected images/" + names[i] + " with " + kImageNames);
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

  // The photograph that lies in images/ where a mask lies in masks/: north/0001.
  std::optional<size_t> FindByPlace(const fs::path& mask) const {
    const std::vector<Photograph>& photographs = result_.scene.photographs;
    for (size_t i = 0; i < photographs.size(); ++i) {
      const std::string image = ImageName(result_.scene, photographs[i]);
      if (WithoutExtension(image) == WithoutExtension(mask.generic_string())) return i;
    }
    return std::nullopt;
  }

  // Reads every pixel, since a damaged file may have a sound header.
  void DecodeAll() {
    const std::vector<Photograph>& photographs = result_.scene.photographs;
    const PolygonModel& model = result_.scene.model;
    std::vector<std::vector<std::string>> faults(photographs.size());
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
      attempt(photograph.image_file, [&] { ReadSrgb8(photograph.image_file); });
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
    }
  }

  // Moves photographs with faults out of the others' way. Returns the faults that are left.
  std::vector<std::string> SetUnreadableApart() {
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

  fs::path folder_;
  SceneOptions options_;
  SceneCheck result_;
  std::vector<std::string> scene_faults_;
  std::map<std::string, std::vector<std::string>, NaturalOrder> faults_of_;  // by photograph
  std::set<fs::path> not_images_;  // whose header cannot be read
  std::map<std::string, FoundTag, NaturalOrder> tags_;
  FilesByStem known_names_;  // every photograph that has a tag, readable or not
  std::string tags_place_;   // where a tag is expected, if not in views/
  fs::path cameras_file_;    // the COLMAP model that gave the tags, if one did
};

}  // namespace

Scene ReadScene(const fs::path& folder, const SceneOptions& options) {
  SceneReading reading = SceneReader(folder, options).Read();
  if (!reading.scene_faults.empty()) throw Error(reading.scene_faults.front());
  Scene scene = std::move(reading.check.scene);
  KeepPhotographs(FindPhotographNames(scene, options.only, "option --only"), scene);
  ForgiveUnreadable(FindPhotographNames(scene, options.exclude, "option --exclude"), scene);
  if (scene.photographs.empty()) {
    // One file that is at fault is told as it is; the others are told as well.
    std::string reasons = "no photograph that can be used";
    for (size_t i = 0; i < scene.unreadable.size(); ++i) {
      const std::string& reason = scene.unreadable[i].reasons.front();
      if (i == 0) reasons = reason;
      if (i > 0 && i < kMostReasons) reasons += "; " + reason;
    }
    if (scene.unreadable.size() > kMostReasons) {
      reasons += "; and " + std::to_string(scene.unreadable.size() - kMostReasons) +
                 " more; groundglass check tells them all";
    }
    throw scene.unreadable.empty() ? Error(folder, reasons) : Error(reasons);
  }
  scene.warnings.insert(
      scene.warnings.end(), reading.stray_faults.begin(), reading.stray_faults.end());
  return scene;
}

SceneCheck CheckScene(const fs::path& folder, const SceneOptions& options) {
  return SceneReader(folder, options).Read().check;
}

std::string ImageName(const Scene& scene, const Photograph& photograph) {
  return photograph.image_file.lexically_relative(scene.folder / "images").generic_string();
}

const Photograph* FindUsablePhotograph(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(
      scene.photographs.begin(), scene.photographs.end(), [&](const Photograph& photograph) {
        return photograph.name == name;
      });
  return found == scene.photographs.end() ? nullptr : &*found;
}

}  // namespace groundglass
