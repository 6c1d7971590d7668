// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/colmap_matches.h"

#include "register/ties/colmap_database.h"
#include "scene/check_option.h"
#include "scene/child_process.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/output_folder.h"
#include "scene/text.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFeaturesNote = "features";
constexpr const char* kMatchesNote = "matches";

ProgramResult RunColmap(const ColmapOptions& options, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), options.program);
  ProgramOptions program;
  program.package = "colmap";
  // It opens a window system before it reads its arguments.
  program.environment = {{"QT_QPA_PLATFORM", "offscreen"}};
  return RunProgram(arguments, program);
}

void RequireColmap(const ColmapOptions& options, const std::vector<std::string>& arguments) {
  const ProgramResult result = RunColmap(options, arguments);
  if (result.exit_code == 0) return;
  throw Error(options.program + " " + arguments.front() + " failed (exit status " +
              std::to_string(result.exit_code) + "): " + OneLine(LastWords(result)));
}

// A folder of working files that goes away with the object, with all that is in it if it is a
// temporary one.
class WorkFolder {
 public:
  explicit WorkFolder(const fs::path& kept) : path_(kept), is_temporary_(kept.empty()) {
    if (is_temporary_) {
      std::string pattern = (fs::temp_directory_path() / "groundglass-colmap-XXXXXX").string();
      if (mkdtemp(pattern.data()) == nullptr) throw Error("cannot make a folder " + pattern);
      path_ = pattern;
    } else {
      fs::create_directories(path_);
    }
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (is_temporary_) fs::remove_all(path_, ignored);
    for (const fs::path& file : {Images(), Masks(), PairList()}) fs::remove_all(file, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  fs::path Database() const { return path_ / "database.db"; }
  fs::path Images() const { return path_ / "images"; }
  fs::path Masks() const { return path_ / "masks"; }
  fs::path PairList() const { return path_ / "pairs.txt"; }

 private:
  fs::path path_;
  bool is_temporary_;
};

// COLMAP parts names in lists at blanks, so photographs get numbers there.
std::string ImageNameOf(size_t photograph) { return fmt::format("{:05}.png", photograph + 1); }

std::vector<std::string> ImageNamesOf(size_t num_photographs) {
  std::vector<std::string> names;
  for (size_t i = 0; i < num_photographs; ++i) names.push_back(ImageNameOf(i));
  return names;
}

std::string BytesOf(const Image8& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height) + ":" +
         std::string(image.values.begin(), image.values.end());
}

std::string KeyOfFeatures(const std::vector<ColmapPhotograph>& photographs,
                          const std::string& version,
                          const ColmapOptions& options) {
  std::string text = version + " " + std::to_string(options.max_keypoints);
  for (const ColmapPhotograph& photograph : photographs) {
    text += " " + HashText(BytesOf(photograph.picture->grey8())) + " " +
            HashText(BytesOf(photograph.picture->ignore()));
  }
  return HashText(text);
}

std::string KeyOfMatches(const std::string& features_key,
                         const std::vector<ColmapPhotograph>& photographs,
                         const std::vector<std::pair<int, int>>& pairs) {
  std::string text = features_key;
  for (const auto& [photograph, camera] : photographs) {
    for (const double number : {camera.focal_x_px,
                                camera.focal_y_px,
                                camera.center_x_px,
                                camera.center_y_px,
                                camera.k1,
                                camera.k2,
                                camera.k3,
                                camera.p1,
                                camera.p2}) {
      text += " " + FormatNumber(number);
    }
  }
  for (const auto& [first, second] : pairs) {
    text += " " + std::to_string(first) + "-" + std::to_string(second);
  }
  return HashText(text);
}

// Whether the database is there and whole, with keypoints of the same pictures.
bool HasFeatures(const fs::path& database, const std::string& key) {
  if (!fs::exists(database)) return false;
  try {
    return ColmapDatabase(database).Note(kFeaturesNote) == key;
  } catch (const Error&) {
    return false;  // it is made again
  }
}

void RemoveDatabase(const fs::path& database) {
  std::error_code ignored;
  for (const char* ending : {"", "-wal", "-shm", "-journal"}) {
    fs::remove(database.string() + ending, ignored);
  }
}

// What COLMAP leaves out in its masks is black.
void WriteWorkingCopies(const std::vector<ColmapPhotograph>& photographs, const WorkFolder& work) {
  fs::create_directories(work.Images());
  fs::create_directories(work.Masks());
  for (size_t i = 0; i < photographs.size(); ++i) {
    const std::string name = ImageNameOf(i);
    WriteSrgb8(work.Images() / name, photographs[i].picture->grey8());
    Image8 mask = photographs[i].picture->ignore();
    if (mask.Empty()) continue;
    for (uint8_t& value : mask.values) value = value ? 0 : 255;
    WriteSrgb8(work.Masks() / (name + ".png"), mask);
  }
}

std::string NumThreads() {
  return std::to_string(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

// What both of COLMAP's programs are told: releases before 3.12 call it SiftExtraction.use_gpu and
// SiftMatching.use_gpu, later ones FeatureExtraction.use_gpu and FeatureMatching.use_gpu.
std::string OptionPrefix(const ColmapOptions& options) {
  const ProgramResult help = RunColmap(options, {"feature_extractor", "-h"});
  const bool is_later =
      (help.output + help.errors).find("--FeatureExtraction.use_gpu") != std::string::npos;
  return is_later ? "--Feature" : "--Sift";
}

void ExtractKeypoints(const std::vector<ColmapPhotograph>& photographs,
                      const std::string& key,
                      const WorkFolder& work,
                      const ColmapOptions& options) {
  RemoveDatabase(work.Database());
  WriteWorkingCopies(photographs, work);
  const std::string prefix = OptionPrefix(options) + "Extraction.";
  RequireColmap(options,
                {"feature_extractor",
                 "--database_path",
                 work.Database().string(),
                 "--image_path",
                 work.Images().string(),
                 "--ImageReader.mask_path",
                 work.Masks().string(),
                 "--ImageReader.single_camera_per_image",
                 "1",
                 "--SiftExtraction.max_num_features",
                 std::to_string(options.max_keypoints),
                 prefix + "use_gpu",
                 "0",
                 prefix + "num_threads",
                 NumThreads()});
  ColmapDatabase(work.Database()).SetNote(kFeaturesNote, key);
}

void MatchKeypoints(const std::vector<ColmapPhotograph>& photographs,
                    const std::vector<std::pair<int, int>>& pairs,
                    const std::string& key,
                    const WorkFolder& work,
                    const ColmapOptions& options) {
  {
    ColmapDatabase database(work.Database());
    if (database.Note(kMatchesNote) == key) return;
    database.SetNote(kMatchesNote, "");
    database.ForgetMatches();
    for (size_t i = 0; i < photographs.size(); ++i) {
      database.SetCamera(ImageNameOf(i), photographs[i].camera);
    }
  }
  std::string list;
  for (const auto& [first, second] : pairs) {
    list += ImageNameOf(first) + " " + ImageNameOf(second) + "\n";
  }
  WriteFileAtomically(work.PairList(), list);
  const std::string prefix = OptionPrefix(options) + "Matching.";
  RequireColmap(options,
                {"matches_importer",
                 "--database_path",
                 work.Database().string(),
                 "--match_list_path",
                 work.PairList().string(),
                 "--match_type",
                 "pairs",
                 prefix + "use_gpu",
                 "0",
                 prefix + "num_threads",
                 NumThreads()});
  ColmapDatabase(work.Database()).SetNote(kMatchesNote, key);
}

std::string HashOfMatches(const FeatureMatches& matches) {
  std::string text;
  for (const std::vector<Keypoint>& keypoints : matches.keypoints) {
    text += "photograph\n";
    for (const Keypoint& keypoint : keypoints) {
      text += FormatNumber(keypoint.image_px.x()) + " " + FormatNumber(keypoint.image_px.y()) +
              " " + FormatNumber(keypoint.scale_px) + "\n";
    }
  }
  for (const FeaturePair& pair : matches.pairs) {
    text += "pair " + std::to_string(pair.first) + " " + std::to_string(pair.second) + "\n";
    for (const auto& [first, second] : pair.matches) {
      text += std::to_string(first) + " " + std::to_string(second) + "\n";
    }
  }
  return HashText(text);
}

}  // namespace

void ColmapOptions::Check(const std::string& path) const {
  if (program.empty()) throw Error(path + "program names no program");
  CheckFromTo(max_keypoints, 1, 1e6, path + "max_keypoints");
  pairs.Check(path + "pairs.");
}

std::string FindColmapVersion(const ColmapOptions& options) {
  const ProgramResult help = RunColmap(options, {"-h"});
  const std::string before = "COLMAP ";
  const size_t at = help.output.find(before);
  if (at == std::string::npos) return "unknown";
  const size_t first = at + before.size();
  return help.output.substr(first, help.output.find_first_of(" \n", first) - first);
}

ColmapMatches MatchWithColmap(const std::vector<ColmapPhotograph>& photographs,
                              const std::vector<std::pair<int, int>>& pairs,
                              const ColmapOptions& options) {
  options.Check();
  if (!ColmapDatabase::IsAvailable()) ColmapDatabase("database.db");  // says so
  ColmapMatches result;
  result.version = FindColmapVersion(options);
  if (pairs.empty()) {
    result.matches.keypoints.resize(photographs.size());
  } else {
    const WorkFolder work(options.folder);
    const std::string features_key = KeyOfFeatures(photographs, result.version, options);
    if (!HasFeatures(work.Database(), features_key)) {
      ExtractKeypoints(photographs, features_key, work, options);
    }
    MatchKeypoints(
        photographs, pairs, KeyOfMatches(features_key, photographs, pairs), work, options);
    result.matches = ColmapDatabase(work.Database()).ReadMatches(ImageNamesOf(photographs.size()));
  }
  result.sha256 = HashOfMatches(result.matches);
  return result;
}

}  // namespace groundglass
