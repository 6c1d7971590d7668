// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/scene_folder.h"

#include "scene/error.h"
#include "scene/select_photographs.h"
#include "scene/tags_csv.h"
#include "scene/text.h"
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
constexpr std::array<std::string_view, 6> kImageExtensions = {
    ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".exr"};
constexpr const char* kModelNames = "model.osu, .obj, .ply, .stl or .glb";
// So many photographs' faults are told where none of them can be used.
constexpr size_t kMostReasons = 3;
constexpr const char* kImageNames = ".jpg, .png, .tif or .exr";

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

  FilesByStem ListImages(const char* subfolder) {
    FilesByStem images;
    for (const fs::path& file : ListFiles(folder_ / subfolder)) {
      if (!HasExtension(file, kImageExtensions)) {
        Warn(file, std::string("not an image that is read here; expected ") + kImageNames);
        continue;
      }
      const auto [place, is_new] = images.emplace(file.stem().string(), file);
      if (!is_new) {
        FaultOf(place->first,
                Error(file,
                      "two images have the stem " + Quote(place->first) + "; the other is " +
                          place->second.filename().string())
                    .what());
      }
    }
    return images;
  }

  void ReadTags(const FilesByStem& images) {
    const fs::path views = folder_ / "views";
    const fs::path table = folder_ / "tags.csv";
    std::error_code error;
    const bool has_table = fs::is_regular_file(table, error);
    if (fs::is_directory(views, error)) {
      if (has_table) Warn(table, "not read, since there is a folder views/");
      for (const fs::path& file : ListFiles(views)) {
        if (file.extension() != ".view") {
          Warn(file, "not a view file; expected the extension .view");
          continue;
        }
        const std::string name = file.stem().string();
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
        for (const TagRow& row : rows.rows) {
          tags_[row.name] = {row.tag, {}};
          known_names_[row.name] = table;
        }
        for (const auto& [name, faults] : rows.row_faults) {
          for (const std::string& fault : faults) FaultOf(name, fault);
          if (images.count(name) > 0) known_names_[name] = table;
        }
        if (!rows.faults.empty()) {
          // A table that cannot be read may have any photograph: do not call them untagged.
          for (const auto& [name, file] : images) known_names_.emplace(name, table);
        }
      } catch (const Error& read_error) {
        Fault(read_error.what());
      }
    } else {
      Fault(
          Error(folder_, "no tags; expected a folder views/ with .view files, or tags.csv").what());
    }
  }

  void Match(const FilesByStem& images) {
    for (const auto& [name, file] : images) {
      if (known_names_.count(name) > 0) continue;
      const std::string expected =
          tags_place_.empty() ? "views/" + name + ".view" : tags_place_ + " for " + name;
      Warn(file, "photograph without a tag; expected " + expected);
    }
    for (const auto& [name, file] : known_names_) {
      if (images.count(name) > 0) continue;
      Warn(file,
           "tag of " + name + " without a photograph; expected images/" + name + " with " +
               kImageNames);
    }
    for (const auto& [name, place] : known_names_) {
      const auto image = images.find(name);
      if (image == images.end()) continue;
      Photograph photograph;
      photograph.name = name;
      photograph.image_file = image->second;
      if (place.extension() == ".view") photograph.view_file = place;
      const auto found = tags_.find(name);
      if (found != tags_.end()) photograph.tag = found->second.tag;
      try {
        photograph.size = ReadImageSize(image->second);
        if (found != tags_.end()) LookForOddities(photograph);
      } catch (const Error& error) {
        FaultOf(name, error.what());
        not_images_.insert(image->second);
      }
      result_.scene.photographs.push_back(std::move(photograph));
    }
    if (result_.scene.photographs.empty() && result_.faults.empty()) {
      Fault(Error(folder_, "no photograph has a tag; expected images/s5.jpg beside views/s5.view")
                .what());
    }
  }

  void LookForOddities(const Photograph& photograph) {
    const fs::path& place =
        photograph.view_file.empty() ? folder_ / "tags.csv" : photograph.view_file;
    const double image_aspect = static_cast<double>(photograph.size.width) / photograph.size.height;
    const double ratio = photograph.tag.aspect / image_aspect;
    // NTSC frames have pixels 1.1 from square; beyond 1.3 somebody has turned something.
    if (ratio > 1.3 || ratio < 1 / 1.3) {
      Warn(place,
           "aspect " + FormatNumber(photograph.tag.aspect) + " does not suit " +
               photograph.image_file.filename().string() + " of " +
               std::to_string(photograph.size.width) + " x " +
               std::to_string(photograph.size.height) + " pixels; is the picture turned?");
    }
    const Camera camera =
        CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height);
    const std::vector<Eigen::Vector3d>& points = result_.scene.model.points_in_world;
    const bool is_behind = std::all_of(points.begin(), points.end(), [&](const auto& point) {
      return (camera.cam_from_world * point).z() <= 0;
    });
    if (!points.empty() && is_behind) {
      Warn(place, "the whole model lies behind this camera; y runs south in view files");
    }
  }

  void AddMasks(const char* subfolder, std::optional<fs::path> Photograph::*member) {
    for (const auto& [name, file] : ListImages(subfolder)) {
      const auto photograph =
          std::find_if(result_.scene.photographs.begin(),
                       result_.scene.photographs.end(),
                       [&](const Photograph& candidate) { return candidate.name == name; });
      if (photograph == result_.scene.photographs.end()) {
        Warn(file, "mask without a photograph; expected images/" + name + " with " + kImageNames);
        continue;
      }
      // Even one that is at fault is an input: whoever mends it wants the job done again.
      (*photograph).*member = file;
      try {
        const ImageSize size = ReadImageSize(file);
        // A picture that cannot be read has no size for a mask to fit.
        if (not_images_.count(photograph->image_file) > 0) continue;
        if (size.width != photograph->size.width || size.height != photograph->size.height) {
          FaultOf(
              name,
              Error(file,
                    "mask has " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                        " pixels, its photograph " + std::to_string(photograph->size.width) +
                        " x " + std::to_string(photograph->size.height))
                  .what());
        }
      } catch (const Error& error) {
        FaultOf(name, error.what());
        not_images_.insert(file);
      }
    }
  }

  // Reads every pixel, since a damaged file may have a sound header.
  void DecodeAll() {
    const std::vector<Photograph>& photographs = result_.scene.photographs;
    const size_t num_faces = result_.scene.model.faces.size();
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
        attempt(*photograph.mask_file, [&] { ReadLabels(*photograph.mask_file); });
      }
      if (photograph.faces_file) {
        attempt(*photograph.faces_file, [&] {
          const Image16 labels = ReadLabels(*photograph.faces_file);
          const uint16_t highest = *std::max_element(labels.values.begin(), labels.values.end());
          if (num_faces > 0 && highest > num_faces) {
            throw Error(*photograph.faces_file,
                        "face number " + std::to_string(highest) + ", but the model has " +
                            std::to_string(num_faces) + " faces");
          }
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

const Photograph* FindPhotograph(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(
      scene.photographs.begin(), scene.photographs.end(), [&](const Photograph& photograph) {
        return photograph.name == name;
      });
  return found == scene.photographs.end() ? nullptr : &*found;
}

bool NaturalLess(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  size_t i = 0;
  size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[k])) {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i;
      ++k;
      continue;
    }
    // Compare two numbers of any length: without leading zeros the longer one is greater.
    size_t i_end = i;
    size_t k_end = k;
    while (i_end < a.size() && is_digit(a[i_end])) ++i_end;
    while (k_end < b.size() && is_digit(b[k_end])) ++k_end;
    while (i + 1 < i_end && a[i] == '0') ++i;
    while (k + 1 < k_end && b[k] == '0') ++k;
    if (i_end - i != k_end - k) return i_end - i < k_end - k;
    const int order = a.compare(i, i_end - i, b, k, k_end - k);
    if (order != 0) return order < 0;
    i = i_end;
    k = k_end;
  }
  if (i < a.size() || k < b.size()) return k < b.size();
  return a < b;  // "s01" and "s1" differ only in zeros
}

}  // namespace groundglass
