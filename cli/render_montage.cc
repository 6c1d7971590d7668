// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/survey.h"
#include "cli/montage_arguments.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/coloured_model_io.h"
#include "scene/formats/ignore_mask.h"
#include "scene/formats/image_io.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <optional>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// The photograph as it is called, and its picture.
struct FoundPhotograph {
  SurveyPhotograph photograph;
  fs::path image_file;
};

// `word`: a name, or a file, which need not be where the scene has it.
FoundPhotograph FindOver(const MontageArguments& arguments,
                         const Survey& survey,
                         const fs::path& folder) {
  const bool is_file = fs::is_regular_file(arguments.photograph);
  const std::string name =
      is_file ? fs::path(arguments.photograph).stem().string() : arguments.photograph;
  FoundPhotograph found = {survey.photographs[FindSurveyPhotograph(survey, name)], {}};
  found.image_file = is_file ? fs::path(arguments.photograph) : found.photograph.image_file;
  if (found.image_file.empty()) {
    throw Error(folder,
                "does not hold the photographs: give --over the photograph's file, or say where "
                "they are with --scene");
  }
  return found;
}

// The design in the building's unit. One that says no unit of its own is drawn in the building's.
TexturedModelReading ReadDesign(const MontageArguments& arguments,
                                ModelOptions options,
                                const PolygonModel& building) {
  TexturedModelReading design = ReadColouredModel(arguments.design, options);
  PolygonModel& model = design.textured.model;
  if (model.is_unit_assumed) model.unit = building.unit;
  ChangeUnit(building.unit, model);
  return design;
}

std::string DescribeLight(const MontageLight& light) {
  const std::string faces =
      std::to_string(light.num_faces) + (light.num_faces == 1 ? " face" : " faces");
  switch (light.source) {
    case LightSource::kDesign:
      return "from " + faces + " of the building that the design repeats in its own colours";
    case LightSource::kBuilding:
      return "from " + faces +
             " of the building, whose lightest are taken to be as light as most buildings'";
    case LightSource::kAssumed:
      break;
  }
  return "not known: the photograph shows too little of the building";
}

const char* SourceName(LightSource source) {
  switch (source) {
    case LightSource::kDesign:
      return "design";
    case LightSource::kBuilding:
      return "building";
    case LightSource::kAssumed:
      break;
  }
  return "assumed";
}

// The share of the picture that shows the design.
double SharedCover(const ImageF& cover) {
  double sum = 0;
  for (const float value : cover.values) sum += value;
  return sum / static_cast<double>(cover.values.size());
}

struct Outcome {
  std::string name;
  Montage montage;
  std::vector<std::string> warnings;
};

void PrintOutcome(const Outcome& outcome, const CommonOptions& common, const fs::path& out) {
  for (const std::string& warning : outcome.warnings) {
    std::fprintf(stderr, "groundglass: warning: %s\n", warning.c_str());
  }
  const Montage& montage = outcome.montage;
  const Eigen::Vector3d& gain = montage.light.gain;
  if (common.json) {
    const nlohmann::ordered_json json = {{"file", out.string()},
                                         {"written", !common.dry_run},
                                         {"photograph", outcome.name},
                                         {"width_px", montage.srgb8.width},
                                         {"height_px", montage.srgb8.height},
                                         {"faces", montage.num_faces},
                                         {"cover", SharedCover(montage.cover)},
                                         {"light",
                                          {{"from", SourceName(montage.light.source)},
                                           {"faces", montage.light.num_faces},
                                           {"gain", {gain[0], gain[1], gain[2]}}}},
                                         {"grain_codes", montage.grain_sigma},
                                         {"warnings", outcome.warnings}};
    std::printf("%s\n", json.dump(2).c_str());
    return;
  }
  std::printf("%s%s: %d x %d, %d faces of the design over %s, %.1f %% of the picture\n",
              common.dry_run ? "would write " : "",
              out.c_str(),
              montage.srgb8.width,
              montage.srgb8.height,
              montage.num_faces,
              outcome.name.c_str(),
              100 * SharedCover(montage.cover));
  std::printf("light: %s; white is %.2f %.2f %.2f of the photograph's light\n",
              DescribeLight(montage.light).c_str(),
              gain[0],
              gain[1],
              gain[2]);
  std::printf("grain: %.1f codes\n", montage.grain_sigma);
}

}  // namespace

int RenderMontage(const MontageArguments& arguments,
                  const CommonOptions& common,
                  const fs::path& folder,
                  const ModelOptions& model_options,
                  const fs::path& out) {
  const OpenedFolder opened = OpenFolder(folder, arguments.scene, {}, true);
  const Survey survey = SurveyOf(opened);
  const FoundPhotograph found = FindOver(arguments, survey, folder);
  RequireOtherFile(found.image_file, out);
  RequireOtherFile(arguments.design, out);
  const SurveyPhotograph& photograph = found.photograph;
  TexturedModelReading design = ReadDesign(arguments, model_options, opened.textured.model);

  const Image8 picture = ReadSrgb8(found.image_file);
  std::optional<Image8> mask;
  if (photograph.mask_file) {
    mask = ReadIgnoreMask(*photograph.mask_file, {picture.width, picture.height});
  }
  MontageOptions options = arguments.montage;
  options.grain = !arguments.no_grain;
  Outcome outcome = {photograph.name,
                     DrawMontage({picture, mask ? &*mask : nullptr, photograph.AsCamera()},
                                 opened.textured,
                                 design.textured,
                                 options),
                     std::move(design.warnings)};
  std::vector<std::string>& warnings = outcome.warnings;
  warnings.insert(warnings.end(), outcome.montage.warnings.begin(), outcome.montage.warnings.end());
  if (photograph.standing != "accepted") {
    warnings.push_back("the camera of " + photograph.name + " is " +
                       (photograph.standing == "review" ? "in review" : photograph.standing) +
                       ": look whether the design stands where it should");
  }
  if (SharedCover(outcome.montage.cover) == 0) {
    warnings.push_back("nothing of the design is seen in " + photograph.name +
                       ": it is out of the picture, or hidden");
  }
  if (!common.dry_run) WriteSrgb8(out, outcome.montage.srgb8);
  PrintOutcome(outcome, common, out);
  return kExitDone;
}

}  // namespace groundglass
