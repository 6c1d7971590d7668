// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/known_keys.h"
#include "scene/formats/metadata_lens.h"
#include "scene/formats/scene_reader.h"
#include "scene/formats/tag_corners.h"
#include "scene/formats/view_io.h"
#include "scene/formats/view_pairs.h"
#include "scene/same_lens.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr size_t kNamesInNote = 3;
constexpr const char* kFromMetadata = "the pictures' own metadata";

// What a lens says instead of a tag's view angle and aspect.
KnownKeys KeysOfLens(const Lens& lens) {
  KnownKeys keys;
  AddKnown(keys, "v", lens.view_angle_deg);
  AddKnown(keys, "a", lens.aspect);
  return keys;
}

bool LacksKey(const std::string& view_text, const char* key) {
  return !KeysLacking(view_text, {{key, "1", ""}}).empty();
}

bool MakesCamera(const std::string& view_text) {
  return !LacksKey(view_text, "x") && !LacksKey(view_text, "i");
}

}  // namespace

void SceneReader::ReadCalibration() {
  if (options_.views) return;  // these cameras are whole
  for (const fs::path& file : ListFiles(folder_ / "calibration")) {
    const std::string extension = LowerCase(file.extension().string());
    try {
      if (extension == ".lens") {
        lenses_.push_back(ReadLens(file));
        result_.scene.lens_files.push_back(file);
      } else if (extension == ".view") {
        const std::string name = NameInUtf8(file, file.stem().string());
        ReadKnownKeys(file);
        calibration_[name] = file;
        const std::string text = ReadTextFile(file);
        // As good as a tag, where there is none.
        if (known_names_.count(name) > 0 || !MakesCamera(text)) continue;
        known_names_[name] = file;
        tags_[name] = {{}, file, text};
      } else if (file.filename() == kTagCornersFile) {
        result_.scene.lens_files.push_back(file);
        std::map<std::string, std::vector<SeenTagCorner>> of_photograph;
        for (const SeenTagCorner& corner : ReadTagCorners(file)) {
          of_photograph[corner.photograph].push_back(corner);
        }
        for (const auto& [name, corners] : of_photograph) {
          taken_[CountTagCorners(corners) + " from calibration/"].push_back(name);
        }
      } else if (extension != ".txt" && extension != ".json") {
        Warn(file,
             "neither a view file nor a lens file; expected the extension .view or .lens, or "
             "apriltag-corners.csv");
      }
    } catch (const Error& error) {
      Fault(error.what());
    }
  }
}

std::string SceneReader::WithLens(std::string text, Photograph& photograph) {
  if (!LacksKey(text, "v")) return text;
  const std::string camera = ReadSomePairs(text, "").tag.camera;
  for (const Lens& lens : lenses_) {
    if (!lens.name.empty() && lens.name != camera) continue;
    photograph.lens = lens;
    taken_["the lens from calibration/"].push_back(photograph.name);
    return WithKeys(text, KeysLacking(text, KeysOfLens(lens)));
  }
  return text;
}

std::string SceneReader::WithMetadata(std::string text,
                                      const Photograph& photograph,
                                      std::string& why_not) {
  if (!LacksKey(text, "v") || not_images_.count(photograph.image_file) > 0) return text;
  const MetadataLens lens = FindMetadataLens(ReadPhotographMetadata(photograph.image_file));
  if (!lens.view_angle_deg) {
    why_not = lens.how;
    return text;
  }
  const KnownKeys keys = KeysLacking(text, KeysOfMetadata(lens, photograph.size));
  taken_[NamesOf(keys) + " from " + kFromMetadata + ", " + lens.how].push_back(photograph.name);
  return WithKeys(text, keys);
}

void SceneReader::CompleteTag(const FoundTag& found, Photograph& photograph) {
  photograph.tag = found.tag;
  if (!found.text) return;
  std::string text = *found.text;
  KnownKeys known;
  if (const auto file = calibration_.find(photograph.name); file != calibration_.end()) {
    photograph.calibration_file = file->second;
    known = ReadKnownKeys(file->second);
  }
  // The camera's name first, which tells the lens; a lens that was measured before its data sheet.
  KnownKeys camera = known;
  std::erase_if(camera, [](const KnownKey& key) { return key.key != kCameraKey; });
  text = WithLens(WithKeys(text, KeysLacking(text, camera)), photograph);
  const KnownKeys taken = KeysLacking(text, known);
  if (!taken.empty() && photograph.view_file != photograph.calibration_file) {
    taken_[NamesOf(taken) + " from calibration/"].push_back(photograph.name);
  }
  if (std::any_of(
          taken.begin(), taken.end(), [](const KnownKey& key) { return key.key == "k1"; })) {
    with_measured_k1_.insert(photograph.name);
  }
  text = WithKeys(text, taken);
  std::string why_not;
  text = WithMetadata(text, photograph, why_not);
  const std::vector<std::string> faults = FaultsOfText(photograph.name, found, text);
  for (const std::string& fault : faults) {
    const bool is_view_angle = fault.ends_with("key 'v' is missing") && !why_not.empty();
    FaultOf(photograph.name, is_view_angle ? fault + ", and " + why_not : fault);
  }
  if (faults.empty()) photograph.tag = ParseView(text, found.view_file);
}

// A lens bends lines by the same in all its photographs, each of which has told it a little. Taken
// as if each had a lens of its own, registration would believe them all.
void SceneReader::ShareMeasuredDistortion() {
  struct OneLens {
    std::vector<ViewTag*> measured;
    std::vector<ViewTag*> unknown;  // nothing says k1 there
  };
  std::map<LensIdentity, OneLens> lenses;
  for (Photograph& photograph : result_.scene.photographs) {
    ViewTag& tag = photograph.tag;
    const bool is_measured = with_measured_k1_.count(photograph.name) > 0 && tag.sigmas.k1;
    if (tag.k2 != 0 || (!is_measured && (tag.k1 != 0 || tag.sigmas.k1))) continue;
    // One whose header cannot be read has no shape.
    if (photograph.size.width < 1 || photograph.size.height < 1) continue;
    OneLens& lens = lenses[LensIdentityOf(tag, photograph.size.width, photograph.size.height)];
    (is_measured ? lens.measured : lens.unknown).push_back(&tag);
  }
  for (auto& [key, lens] : lenses) {
    std::vector<ViewTag*>& tags = lens.measured;
    if (tags.empty()) continue;
    double weights = 0;
    double sum = 0;
    for (const ViewTag* tag : tags) {
      const double weight = 1 / (*tag->sigmas.k1 * *tag->sigmas.k1);
      weights += weight;
      sum += weight * tag->k1;
    }
    const double mean = sum / weights;
    double chi_squared = 0;
    for (const ViewTag* tag : tags) {
      chi_squared += (tag->k1 - mean) * (tag->k1 - mean) / (*tag->sigmas.k1 * *tag->sigmas.k1);
    }
    // Where they differ by more than they say, they know less than they say.
    const double excess =
        tags.size() > 1 ? std::max(1.0, chi_squared / static_cast<double>(tags.size() - 1)) : 1;
    tags.insert(tags.end(), lens.unknown.begin(), lens.unknown.end());
    for (ViewTag* tag : tags) {
      tag->k1 = mean;
      tag->sigmas.k1 = std::sqrt(excess / weights);
    }
  }
}

void SceneReader::TellWhatWasTaken() {
  for (const auto& [what, names] : taken_) {
    std::string list;
    for (size_t i = 0; i < std::min(kNamesInNote, names.size()); ++i) {
      list += (i == 0 ? "" : ", ") + names[i];
    }
    if (names.size() > kNamesInNote) {
      list += " and " + std::to_string(names.size() - kNamesInNote) + " more";
    }
    result_.scene.notes.push_back(list + ": " + what);
  }
}

}  // namespace groundglass
