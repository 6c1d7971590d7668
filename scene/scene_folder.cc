// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/scene_folder.h"

#include "scene/error.h"
#include "scene/tags_csv.h"
#include "scene/text.h"
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
constexpr std::array<std::string_view, 6> kImageExtensions = {
    ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".exr"};
constexpr const char* kModelNames = "model.osu, .obj, .ply, .stl or .glb";
constexpr const char* kImageNames = ".jpg, .png, .tif or .exr";

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

struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const { return NaturalLess(a, b); }
};
using FilesByStem = std::map<std::string, fs::path, NaturalOrder>;

struct FoundTag {
  ViewTag tag;
  fs::path view_file;
};

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

  FilesByStem ListImages(const char* subfolder) {
    FilesByStem images;
    for (const fs::path& file : ListFiles(folder_ / subfolder)) {
      if (!HasExtension(file, kImageExtensions)) {
        Warn(file, std::string("not an image that is read here; expected ") + kImageNames);
        continue;
      }
      const auto [place, is_new] = images.emplace(file.stem().string(), file);
      if (!is_new) {
        Fault(Error(file,
                    "two images have the stem " + Quote(place->first) + "; the other is " +
                        place->second.filename().string()));
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
    } else {
      Fault(Error(folder_,
                  std::string("no tags; expected a folder views/ with .view files, or tags.csv. ") +
                      kHowToBegin));
    }
  }

  void Match(const FilesByStem& images) {
    for (const auto& [name, file] : images) {
      if (known_names_.count(name) > 0) continue;
      const std::string expected =
          tags_place_.empty() ? "views/" + name + ".view" : tags_place_ + " for " + name;
      result_.scene.untagged_images.push_back(file);
      Warn(file, "photograph without a tag; expected " + expected);
    }
    for (const auto& [name, file] : known_names_) {
      if (images.count(name) > 0) continue;
      Warn(file,
           "tag of " + name + " without a photograph; expected images/" + name + " with " +
               kImageNames);
    }
    for (const auto& [name, found] : tags_) {
      const auto image = images.find(name);
      if (image == images.end()) continue;
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
      result_.scene.photographs.push_back(std::move(photograph));
    }
    if (result_.scene.photographs.empty() && result_.faults.empty()) {
      Fault(Error(folder_,
                  std::string("no photograph has a tag; expected images/s5.jpg beside "
                              "views/s5.view. ") +
                      kHowToBegin));
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
      try {
        const ImageSize size = ReadImageSize(file);
        if (size.width != photograph->size.width || size.height != photograph->size.height) {
          throw Error(file,
                      "mask has " + std::to_string(size.width) + " x " +
                          std::to_string(size.height) + " pixels, its photograph " +
                          std::to_string(photograph->size.width) + " x " +
                          std::to_string(photograph->size.height));
        }
        (*photograph).*member = file;
      } catch (const Error& error) {
        Fault(error);
      }
    }
  }

  // Reads every pixel, since a damaged file may have a sound header.
  void DecodeAll() {
    const std::vector<Photograph>& photographs = result_.scene.photographs;
    const size_t num_faces = result_.scene.model.faces.size();
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
      if (photograph.mask_file) attempt([&] { ReadLabels(*photograph.mask_file); });
      if (photograph.faces_file) {
        attempt([&] {
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
