// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/scene_folder.h"

#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/given_cameras.h"
#include "scene/image_paths.h"
#include "scene/tags_csv.h"
#include "scene/text.h"
#include "scene/text_encoding.h"
#include "scene/view_io.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

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

constexpr const char* kCamerasExpected =
    "no cameras here; expected .view files named after the photographs, or a COLMAP model "
    "(cameras.txt and images.txt, or cameras.bin and images.bin; in sparse/0 too)";

// Where the .view files of a folder given in place of the scene's own lie: in it, or in its views/
// if it is an output folder.
fs::path FindViews(const fs::path& given) {
  for (const fs::path& folder : {given, given / "views"}) {
    for (const fs::path& file : ListFiles(folder)) {
      if (file.extension() == ".view") return folder;
    }
  }
  return {};
}

// Gathers a scene and its faults, part by part, each as far as it can be read.
class SceneReader {
 public:
  SceneReader(const fs::path& folder, const SceneOptions& options)
      : folder_(folder), options_(options) {
    result_.scene.folder = folder;
  }

  SceneCheck Read(bool decode_pixels) {
    std::error_code error;
    if (!fs::is_directory(folder_, error)) {
      Fault(Error(folder_, "no such scene folder"));
      return std::move(result_);
    }
    ReadTheModel();
    const FilesByStem images = ListImages("images");
    ReadTags(images);
    Match(images);
    AddMasks("masks", &Photograph::mask_file);
    AddMasks("faces", &Photograph::faces_file);
    if (decode_pixels) DecodeAll();
    return std::move(result_);
  }

 private:
  void Fault(const Error& error) { result_.faults.push_back(error.what()); }
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
        Fault(Error(folder_, std::string("no model; expected ") + kModelNames));
        return;
      }
      if (found.size() > 1) {
        Fault(Error(folder_,
                    "two models, " + found[0].filename().string() + " and " +
                        found[1].filename().string() + "; keep one, or choose it with --model"));
        return;
      }
      file = found.front();
    }
    if (LowerCase(file.extension().string()) == ".osu" && fs::is_regular_file(file)) {
      const std::vector<std::string> faults = FindOsuFaults(ReadTextFile(file), file);
      result_.faults.insert(result_.faults.end(), faults.begin(), faults.end());
      if (!faults.empty()) return;
    }
    try {
      ModelReading reading = ReadModel(file, options_.model);
      result_.scene.model = std::move(reading.model);
      std::vector<std::string>& warnings = result_.scene.warnings;
      warnings.insert(warnings.end(), reading.warnings.begin(), reading.warnings.end());
    } catch (const Error& error) {
      Fault(error);
    }
  }

  // By the photographs' names; files in sub-folders may have the same stem (image_paths.h).
  FilesByStem ListImages(const char* subfolder) {
    const fs::path folder = folder_ / subfolder;
    std::vector<std::string> paths = ListFilesBelow(folder);
    std::erase_if(paths, [&](const std::string& path) {
      if (HasExtension(path, kImageExtensions)) return false;
      Warn(folder / path, std::string("not an image that is read here; expected ") + kImageNames);
      return true;
    });
    const std::vector<std::string> names = NamePhotographs(paths);
    FilesByStem images;
    for (size_t i = 0; i < paths.size(); ++i) {
      const auto [place, is_new] = images.emplace(names[i], folder / paths[i]);
      if (!is_new) {
        Fault(Error(folder / paths[i],
                    "two images have the stem " + Quote(place->first) + "; the other is " +
                        place->second.filename().string()));
      }
      Fault(Error(file,
                  "two images have the stem " + Quote(place->first) + "; the other is " +
                      place->second.filename().string()));
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
        Fault(read_error);
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
        if (file.extension() != ".view") {
          Warn(file, "not a view file; expected the extension .view");
          continue;
        }
        const std::string name = NameInUtf8(file, file.stem().string());
        try {
          const std::string text = ReadTextFile(file);
          const std::vector<std::string> faults = FindViewFaults(text, file);
          result_.faults.insert(result_.faults.end(), faults.begin(), faults.end());
          if (faults.empty()) tags_[name] = {ParseView(text, file), file};
          known_names_[name] = file;
        } catch (const Error& read_error) {
          Fault(read_error);
        }
      }
    } else if (has_table) {
      tags_place_ = "a row in tags.csv";
      try {
        const TagTable rows = ReadTagTable(table, result_.scene.model);
        result_.faults.insert(result_.faults.end(), rows.faults.begin(), rows.faults.end());
        std::vector<std::string>& warnings = result_.scene.warnings;
        warnings.insert(warnings.end(), rows.warnings.begin(), rows.warnings.end());
        for (const TagRow& row : rows.rows) {
          tags_[row.name] = {row.tag, {}};
          known_names_[row.name] = table;
        }
        if (!rows.faults.empty()) {
          // A row that cannot be read may be any photograph's: do not call them untagged.
          for (const auto& [name, file] : images) known_names_.emplace(name, table);
        }
      } catch (const Error& read_error) {
        Fault(read_error);
      }
    } else if (options_.views) {
      Fault(Error(*options_.views, kCamerasExpected));
    } else {
      Fault(Error(folder_, "no tags; expected a folder views/ with .view files, or tags.csv"));
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
    result_.faults.insert(result_.faults.end(), given.faults.begin(), given.faults.end());
    std::map<std::string, std::vector<std::string>> names_of_change;
    for (const auto& [index, camera] : given.camera_of_image) {
      const fs::path& image_file = images.at(names[index]);
      try {
        const FittedCamera fitted = FitCamera(camera.camera, ReadImageSize(image_file), image_file);
        tags_[names[index]] = {TagForModel(fitted.camera, result_.scene.model), {}};
        if (!fitted.change.empty()) names_of_change[fitted.change].push_back(names[index]);
      } catch (const Error& error) {
        Fault(error);
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
      Fault(Error(files.images_file, "no photograph in images/ has the name of any of its images"));
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
      Warn(images.at(name), "photograph without a tag; expected " + expected);
    }
    for (const auto& [name, file] : known_names_) {
      if (image_of_tag.count(name) > 0) continue;
      Warn(file,
           "tag of " + name + " without a photograph; expected images/" + name + " with " +
               kImageNames + NearestName(name, left));
    }
    for (const auto& [name, found] : tags_) {
      const auto image = image_of_tag.find(name);
      if (image == image_of_tag.end()) continue;
      Photograph photograph;
      photograph.name = name;
      photograph.image_file = image->second;
      photograph.tag = found.tag;
      photograph.view_file = found.view_file;
      try {
        photograph.size = ReadImageSize(image->second);
      } catch (const Error& error) {
        Fault(error);
        continue;
      }
      try {
        for (const std::string& warning : InspectImage(image->second).warnings) {
          result_.scene.warnings.push_back(warning);
        }
      } catch (const Error&) {
        // Reading its pixels says the same.
      }
      LookForOddities(photograph);
      result_.scene.photographs.push_back(std::move(photograph));
    }
    if (result_.scene.photographs.empty() && result_.faults.empty()) {
      Fault(Error(folder_, "no photograph has a tag; expected images/s5.jpg beside views/s5.view"));
    }
  }

  void LookForOddities(const Photograph& photograph) {
    const fs::path place = !photograph.view_file.empty() ? photograph.view_file
                           : !cameras_file_.empty()      ? cameras_file_
                                                         : folder_ / "tags.csv";
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
      Warn(place,
           cameras_file_.empty()
               ? "the whole model lies behind this camera; y runs south in view files"
               : "the whole model lies behind the camera of " + photograph.name);
    }
  }

  void AddMasks(const char* subfolder, std::optional<fs::path> Photograph::*member) {
    std::vector<std::string> names;
    std::vector<fs::path> files;
    for (const auto& [name, file] : ListImages(subfolder)) {
      const std::string place =
          WithoutExtension(file.lexically_relative(folder_ / subfolder).generic_string());
      const auto photograph =
          std::find_if(result_.scene.photographs.begin(),
                       result_.scene.photographs.end(),
                       [&](const Photograph& candidate) {
                         return candidate.name == name ||
                                WithoutExtension(ImageName(result_.scene, candidate)) == place;
                       });
      if (photograph == result_.scene.photographs.end()) {
        Warn(file, "mask without a photograph; expected images/" + name + " with " + kImageNames);
        continue;
      }
      Photograph& photograph = photographs[*matches[i]];
      try {
        CheckMaskSize(file, ReadImageSize(file), photograph.size);
        photograph.*member = file;
      } catch (const Error& error) {
        Fault(error);
      }
    }
  }

  // Reads every pixel, since a damaged file may have a sound header.
  void DecodeAll() {
    const std::vector<Photograph>& photographs = result_.scene.photographs;
    const PolygonModel& model = result_.scene.model;
    std::vector<std::vector<std::string>> faults(photographs.size());
    tbb::parallel_for(size_t{0}, photographs.size(), [&](size_t i) {
      const auto attempt = [&](auto read) {
        try {
          read();
        } catch (const Error& error) {
          faults[i].push_back(error.what());
        }
      };
      const Photograph& photograph = photographs[i];
      attempt([&] { ReadSrgb8(photograph.image_file); });
      if (photograph.mask_file) {
        attempt([&] { ReadIgnoreMask(*photograph.mask_file, photograph.size); });
      }
      if (photograph.faces_file) {
        attempt([&] {
          const Image16 numbers = ReadLabels(*photograph.faces_file);
          if (!model.faces.empty()) LabelsFromNumbers(model, numbers, *photograph.faces_file);
        });
      }
    });
    for (const std::vector<std::string>& lines : faults) {
      result_.faults.insert(result_.faults.end(), lines.begin(), lines.end());
    }
  }

  fs::path folder_;
  SceneOptions options_;
  SceneCheck result_;
  std::map<std::string, FoundTag, NaturalOrder> tags_;
  FilesByStem known_names_;  // every photograph that has a tag, readable or not
  std::string tags_place_;   // where a tag is expected, if not in views/
  fs::path cameras_file_;    // the COLMAP model that gave the tags, if one did
};

}  // namespace

Scene ReadScene(const fs::path& folder, const SceneOptions& options) {
  SceneCheck check = SceneReader(folder, options).Read(false);
  if (!check.faults.empty()) throw Error(check.faults.front());
  return std::move(check.scene);
}

SceneCheck CheckScene(const fs::path& folder, const SceneOptions& options) {
  return SceneReader(folder, options).Read(true);
}

std::string ImageName(const Scene& scene, const Photograph& photograph) {
  return photograph.image_file.lexically_relative(scene.folder / "images").generic_string();
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
