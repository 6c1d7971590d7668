// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/error.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/scene.h"
#include "scene/text.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace groundglass {

// Said where no photograph has a tag.
inline constexpr const char* kHowToBegin =
    "A tag says where the camera stood (x y z), the point that it looked at (i j k), the frame's "
    "width / height (a) and its horizontal view angle in degrees (v): groundglass check SCENE "
    "--template writes one for each photograph, to be filled in; docs/tutorial.md tells how. "
    "Cameras that are known already (a COLMAP model, a folder of .view files) need no tags: give "
    "them to run, register or invrender with --views";

// The plain files of a folder in natural order, hidden ones left out; none if there is no folder.
std::vector<std::filesystem::path> ListFiles(const std::filesystem::path& folder);

struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const { return NaturalLess(a, b); }
};
using FilesByStem = std::map<std::string, std::filesystem::path, NaturalOrder>;

// Why a picture that can be read shows nothing, with what to do; empty if it shows something.
std::string WhyNothingIsSeen(const Image8& srgb8, const std::filesystem::path& file);

struct FoundTag {
  ViewTag tag;  // of cameras that are given whole; else `text` says it
  std::filesystem::path view_file;
  std::optional<std::string> text;
  int line = 0;  // of the table; 0: it is not from one
};

// What is taken over from elsewhere, by what is said of it: "v from ..." and the photographs'
// names.
using NamesByNote = std::map<std::string, std::vector<std::string>>;

// A scene and its faults, told apart by what they spoil.
struct SceneReading {
  SceneCheck check;                       // with every fault, in the order of reading
  std::vector<std::string> scene_faults;  // of the whole: nothing can be done with this scene
  std::vector<std::string> stray_faults;  // of files that no photograph needs
};

// Gathers a scene and its faults, part by part, each as far as it can be read.
class SceneReader {
 public:
  SceneReader(const std::filesystem::path& folder, const SceneOptions& options);
  // decode_pictures: whether every pixel is read, so that damage is found now.
  SceneReading Read(bool decode_pictures = true);

 private:
  // Of the scene as a whole.
  void Fault(const std::string& line) {
    result_.faults.push_back(line);
    scene_faults_.push_back(line);
  }
  std::string OtherModels() const;
  std::optional<std::string> OtherThanAFile(const std::string& name) const;
  // Of one photograph, its tag or its masks.
  void FaultOf(const std::string& name, const std::string& line) {
    result_.faults.push_back(line);
    faults_of_[name].push_back(line);
  }
  void Warn(const std::filesystem::path& file, const std::string& message) {
    result_.scene.warnings.push_back(Error(file, message).what());
  }

  // Why nothing of a folder or table of the scene is read: a link that leads nowhere, no
  // permission, another name. Empty: nothing hinders, or there is none.
  std::string WhyNotRead(const std::string& name) const;
  void TellWhatIsNotRead();
  // What is no file in a folder of files, and in its folders; told once the tags are known.
  void TellOddEntries(const std::filesystem::path& folder);

  void ReadTheModel();
  // The images of a folder and of those in it, by the photographs' names (image_paths.h), and what
  // else lies there told once.
  FilesByStem ListImages(const char* subfolder);
  // A name from a file's, which old archives may have in Latin-1.
  std::string NameInUtf8(const std::filesystem::path& file, const std::string& name);
  void ReadTags(const FilesByStem& images);
  void ReadViewFiles(const std::filesystem::path& views);
  void ReadTable(const std::filesystem::path& table, const FilesByStem& images);
  // The tags of a COLMAP model's cameras.
  void ReadGivenCameras(const ColmapFiles& files, const FilesByStem& images);
  void Match(const FilesByStem& images);
  // A photograph that no tag is there for; image_of_tag: those of the tags.
  void TellUntagged(const std::string& name,
                    const FilesByStem& images,
                    const std::map<std::string, std::filesystem::path>& image_of_tag);
  // What a view file's text lacks, with the tag's place: the view file, or the table's line.
  std::vector<std::string> FaultsOfText(const std::string& name,
                                        const FoundTag& found,
                                        const std::string& text) const;
  // A line of the table that is of no photograph and gives no place: "Summe;3;;".
  bool IsNoTag(const std::string& name, const FilesByStem& images, const FoundTag& found) const;
  // The faults of a table in the order of its lines, whoever has found them.
  void SortTableFaults();
  // calibration/: what is known of photographs and lenses besides the tags.
  void ReadCalibration();
  // The tag of a photograph from its view file's text, and what that lacks from calibration/ and
  // from the picture's metadata; faults where nothing tells it.
  void CompleteTag(const FoundTag& found, Photograph& photograph);
  std::string WithLens(std::string text, Photograph& photograph);
  std::string WithMetadata(std::string text, const Photograph& photograph, std::string& why_not);
  // What was measured of one lens in several photographs, taken together.
  void ShareMeasuredDistortion();
  void TellWhatWasTaken();
  void AddMasks(const char* subfolder, std::optional<std::filesystem::path> Photograph::*member);
  // The photograph that lies in images/ where a mask lies in masks/: north/0001.
  std::optional<size_t> FindByPlace(const std::filesystem::path& mask) const;
  // Reads every pixel, since a damaged file may have a sound header.
  void DecodeAll();
  void DecodeUntagged();
  // Moves photographs with faults out of the others' way. Returns the faults that are left.
  std::vector<std::string> SetUnreadableApart();

  std::filesystem::path folder_;
  SceneOptions options_;
  SceneCheck result_;
  std::vector<std::string> scene_faults_;
  std::map<std::string, std::vector<std::string>, NaturalOrder> faults_of_;  // by photograph
  std::set<std::filesystem::path> not_images_;  // whose header cannot be read
  std::map<std::string, FoundTag, NaturalOrder> tags_;
  FilesByStem calibration_;   // its view files, by photograph
  std::vector<Lens> lenses_;  // of calibration/
  NamesByNote taken_;
  std::set<std::string> with_measured_k1_;  // photographs whose k1 is from calibration/
  FilesByStem known_names_;                 // every photograph that has a tag, readable or not
  std::filesystem::path cameras_file_;      // the COLMAP model that gave the tags, if one did
};

}  // namespace groundglass
