// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/scene_folder.h"

#include "scene/error.h"
#include "scene/ignore_mask.h"
#include "scene/image_kind.h"
#include "scene/photograph_name.h"
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

  // The images of a sub-folder by their names, and what else lies there told once.
  FilesByStem ListImages(const char* subfolder) {
    FilesByStem images;
    for (const fs::path& file : ListFiles(folder_ / subfolder)) {
      const ImageKind kind = FindImageKind(file);
      if (!kind.IsImage() && !IsImageExtension(file.extension().string())) {
        Warn(file,
             "not an image that is read here, but " + kind.description + "; expected " +
                 kImageNames + "; " + kind.remedy);
        continue;
      }
      const std::string name = NameInUtf8(file, ImageStem(file));
      const auto [place, is_new] = images.emplace(name, file);
      if (is_new) continue;
      // Cameras write both; the picture that is developed already is the better known one.
      const bool is_raw = kind.reader == "raw";
      if (is_raw != (FindImageKind(place->second).reader == "raw")) {
        const fs::path raw_file = is_raw ? file : place->second;
        if (!is_raw) place->second = file;
        Warn(raw_file,
             "camera raw file left out, since " + place->second.filename().string() +
                 " is there too");
        continue;
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
    } else {
      Fault(Error(folder_, "no tags; expected a folder views/ with .view files, or tags.csv"));
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
    std::vector<std::string> names;
    std::vector<fs::path> files;
    for (const auto& [name, file] : ListImages(subfolder)) {
      names.push_back(name);
      files.push_back(file);
    }
    std::vector<Photograph>& photographs = result_.scene.photographs;
    const std::vector<std::optional<size_t>> matches =
        MatchPhotographs(names, NamesOf(photographs));
    for (size_t i = 0; i < files.size(); ++i) {
      const fs::path& file = files[i];
      if (!matches[i]) {
        Warn(file,
             "mask without a photograph; expected images/" + names[i] + " with " + kImageNames);
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
      if (photograph.mask_file) {
        attempt([&] { ReadIgnoreMask(*photograph.mask_file, photograph.size); });
      }
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

}  // namespace groundglass
