// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_tags.h"
#include "cli/calibrate_parts.h"
#include "cli/calibration_scene.h"
#include "cli/json_output.h"
#include "register/register.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/lens.h"
#include "scene/formats/metadata_lens.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct TagsArguments {
  CalibrationArguments calibration;
  std::optional<fs::path> survey_file;
  std::optional<fs::path> lens_file;
  TagsOptions options;
};

// A pose that no one looks at, so that what is known of the lens makes a tag.
constexpr const char* kAnyPose = "x 0 y 0 z 0\ni 1 j 0 k 0\n";

KnownKeys KeysOfLensFile(const Lens& lens) {
  KnownKeys keys;
  const auto add = [&](const char* name, double value) { AddKnown(keys, name, value); };
  add("v", lens.view_angle_deg);
  if (lens.sigma_view_angle_deg > 0) add("sigma_v", lens.sigma_view_angle_deg);
  add("a", lens.aspect);
  if (lens.sigma_aspect > 0) add("sigma_a", lens.sigma_aspect);
  add("shift_x", lens.shift_x);
  add("shift_y", lens.shift_y);
  if (lens.sigma_shift_x > 0) add("sigma_shift", lens.sigma_shift_x);
  add("k1", lens.k1);
  add("k2", lens.k2);
  add("k3", lens.k3);
  add("p1", lens.p1);
  add("p2", lens.p2);
  if (lens.sigma_k1 > 0) add("sigma_k1", lens.sigma_k1);
  return keys;
}

KnownKeys WithoutPose(const KnownKeys& keys) {
  KnownKeys lens;
  for (const KnownKey& key : keys) {
    const bool is_pose = key.key.size() == 1 && key.key != "a" && key.key != "v";
    const bool is_its_sigma = key.key == "sigma_position" || key.key == "sigma_height" ||
                              key.key == "sigma_lookat" || key.key == "roll" ||
                              key.key == "sigma_roll";
    if (!is_pose && !is_its_sigma) lens.push_back(key);
  }
  return lens;
}

// What is known of a photograph's lens: the file that is given, else its tag, what calibration/
// has, and its own metadata, in this order.
ViewTag FindLensTag(const CalibrationScene& scene,
                    const CalibrationPhotograph& photograph,
                    const std::optional<Lens>& lens) {
  std::string text = kAnyPose;
  const auto add = [&](const KnownKeys& keys) { text = WithKeys(text, KeysLacking(text, keys)); };
  if (lens) add(KeysOfLensFile(*lens));
  for (const char* folder : {"views", "calibration"}) {
    const fs::path file = scene.scene_folder / folder / (photograph.name + ".view");
    if (!scene.scene_folder.empty() && fs::is_regular_file(file)) {
      add(WithoutPose(ReadKnownKeys(file)));
    }
  }
  const ImageSize size = ReadImageSize(photograph.file);
  const MetadataLens metadata = FindMetadataLens(ReadPhotographMetadata(photograph.file));
  add(KeysOfMetadata(metadata, size));
  KnownKeys square;
  AddKnown(square, "a", static_cast<double>(size.width) / size.height);
  add(square);
  if (!FindViewFaults(text, photograph.file).empty()) {
    throw Error(photograph.file,
                "its view angle is not known; give --lens, a tag with v, or metadata");
  }
  return ParseView(text, photograph.file);
}

// The place that the photograph's own tag has, where it has one.
std::optional<WrittenPlace> FindWrittenPlace(const CalibrationScene& scene,
                                             const CalibrationPhotograph& photograph,
                                             LengthUnit unit) {
  const fs::path file = scene.scene_folder / "views" / (photograph.name + ".view");
  if (scene.scene_folder.empty() || !fs::is_regular_file(file)) return std::nullopt;
  const KnownKeys keys = ReadKnownKeys(file);
  const auto number = [&](const char* name) -> std::optional<double> {
    const auto at = std::find_if(
        keys.begin(), keys.end(), [&](const KnownKey& key) { return key.key == name; });
    return at == keys.end() ? std::nullopt : ParseNumber(at->value);
  };
  const auto x = number("x");
  const auto y = number("y");
  const auto z = number("z");
  if (!x || !y || !z) return std::nullopt;
  const PriorOptions usual = PriorSuitedTo(scene.model.value_or(PolygonModel()), {});
  return WrittenPlace{
      {*x, *y, *z},
      number("sigma_position").value_or(usual.OwnPositionMetres() / MetresPerUnit(unit))};
}

KnownKeys KeysOfTags(const TagsResult& result) {
  KnownKeys keys;
  if (!result.is_found) return keys;
  const ViewTag& tag = result.tag;
  const std::string from = std::to_string(result.ids.size()) + " tags";
  const auto add_point = [&](const std::array<const char*, 3>& names, const Eigen::Vector3d& p) {
    for (int i = 0; i < 3; ++i) AddKnown(keys, names[static_cast<size_t>(i)], p[i]);
  };
  add_point({"x", "y", "z"}, tag.position_in_site);
  AddKnown(keys, "sigma_position", *tag.sigmas.position, from);
  AddKnown(keys, "sigma_height", *tag.sigmas.height);
  add_point({"i", "j", "k"}, tag.lookat_in_site);
  AddKnown(keys, "sigma_lookat", *tag.sigmas.lookat);
  AddKnown(keys, "roll", tag.roll_deg);
  AddKnown(keys, "sigma_roll", *tag.sigmas.roll_deg);
  AddKnown(keys, "v", tag.view_angle_deg);
  AddKnown(keys, "sigma_v", *tag.sigmas.view_angle_deg);
  AddKnown(keys, "a", tag.aspect);
  return keys;
}

fs::path SurveyFile(const TagsArguments& arguments, const CalibrationScene& scene) {
  if (arguments.survey_file) return *arguments.survey_file;
  if (!scene.scene_folder.empty()) return scene.scene_folder / "apriltags.csv";
  throw CLI::RequiredError("--tags FILE");
}

int RunCalibrateTags(const TagsArguments& arguments) {
  const CommonOptions& common = arguments.calibration.common;
  const CalibrationScene scene = ReadCalibrationScene(arguments.calibration);
  const LengthUnit unit = scene.model ? scene.model->unit : LengthUnit::kFoot;
  const std::vector<SurveyedTag> survey = ReadSurveyedTags(SurveyFile(arguments, scene), unit);
  std::optional<Lens> lens;
  if (arguments.lens_file) lens = ReadLens(*arguments.lens_file);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  size_t num_failed = 0;
  std::vector<SeenTagCorner> corners;
  for (const CalibrationPhotograph& photograph : scene.photographs) {
    TagsResult result;
    KnownKeys keys;
    try {
      result = CalibrateTags(ReadGrey8(photograph.file),
                             survey,
                             FindLensTag(scene, photograph, lens),
                             arguments.options,
                             FindWrittenPlace(scene, photograph, unit));
      keys = KeysOfTags(result);
      if (!common.dry_run) WriteKnownKeys(scene, photograph.name, keys, "tags");
      for (SeenTagCorner& corner : result.corners) {
        corner.photograph = photograph.name;
        corners.push_back(corner);
      }
    } catch (const Error& error) {
      ++num_failed;
      result = {};
      keys.clear();
      result.reason = error.what();
    }
    if (common.json) {
      nlohmann::ordered_json own = {{"name", photograph.name}, {"found", result.is_found}};
      if (!result.is_found) own["reason"] = result.reason;
      for (const KnownKey& key : keys) own[key.key] = key.value;
      json.push_back(own);
    } else if (result.is_found) {
      std::printf("%s: %s; %zu tags, %.2f px\n",
                  photograph.name.c_str(),
                  DescribeKnownKeys(keys).c_str(),
                  result.ids.size(),
                  result.rms_px);
    } else {
      std::printf("%s: nothing, since %s\n", photograph.name.c_str(), result.reason.c_str());
    }
  }
  if (!common.dry_run && !scene.out_folder.empty()) {
    WriteFileAtomically(scene.out_folder / kTagCornersFile, FormatTagCorners(corners));
  }
  if (common.json) PrintJson({{"photographs", json}});
  return ExitOfCalibration(num_failed, scene.photographs.size());
}

}  // namespace

void AddCalibrateTags(CLI::App* calibrate, int& exit_status) {
  auto arguments = std::make_shared<TagsArguments>();
  CLI::App* command = calibrate->add_subcommand(
      "tags", "Place and direction of photographs that show AprilTags at surveyed places");
  AddCalibrationArguments(command, arguments->calibration);
  command
      ->add_option("--tags",
                   arguments->survey_file,
                   "where the tags are; the scene folder's apriltags.csv if not given")
      ->type_name("FILE");
  command->add_option("--lens", arguments->lens_file, "lens file of the photographs' camera")
      ->type_name("FILE");
  AddExample(command, "groundglass calibrate tags hall --lens my.lens");
  command->callback([arguments, &exit_status] {
    exit_status =
        RunWithThreads(arguments->calibration.common, [&] { return RunCalibrateTags(*arguments); });
  });
}

}  // namespace groundglass
