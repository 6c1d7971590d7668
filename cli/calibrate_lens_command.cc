// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/geoid.h"
#include "calibrate/photograph_place.h"
#include "cli/calibrate_parts.h"
#include "cli/calibration_scene.h"
#include "cli/json_output.h"
#include "scene/error.h"
#include "scene/formats/metadata_lens.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {
namespace {

struct LensArguments {
  CalibrationArguments calibration;
  MetadataLensOptions lens;
  PlaceOptions place;
  std::string geoid;  // metres, or the name of a grid
};

// What a photograph's metadata give.
struct LensFinding {
  KnownKeys keys;
  std::string how;                  // of the view angle, or why there is none
  std::vector<std::string> unused;  // what cannot be meant or used, and why
};

LensFinding FindLens(const CalibrationPhotograph& photograph,
                     const std::optional<PolygonModel>& model,
                     const LensArguments& arguments) {
  const PhotographMetadata metadata = ReadPhotographMetadata(photograph.file);
  const MetadataLens lens = FindMetadataLens(metadata, arguments.lens);
  const PhotographPlace place =
      FindPhotographPlace(metadata, model.value_or(PolygonModel()), arguments.place);
  LensFinding finding{place.keys, lens.how, metadata.faults};
  finding.unused.insert(finding.unused.end(), place.faults.begin(), place.faults.end());
  const KnownKeys keys = KeysOfMetadata(lens, metadata.size);
  finding.keys.insert(finding.keys.end(), keys.begin(), keys.end());
  return finding;
}

void PrintFinding(const std::string& name, const LensFinding& finding) {
  const std::string found = DescribeKnownKeys(finding.keys);
  std::printf(
      "%s: %s%s%s\n", name.c_str(), found.c_str(), found.empty() ? "" : "; ", finding.how.c_str());
  for (const std::string& unused : finding.unused) {
    std::printf("%s: NOT USED: %s\n", name.c_str(), unused.c_str());
  }
}

nlohmann::ordered_json JsonFromFinding(const std::string& name, const LensFinding& finding) {
  nlohmann::ordered_json keys = nlohmann::ordered_json::object();
  for (const KnownKey& key : finding.keys) keys[key.key] = key.value;
  return {{"name", name}, {"keys", keys}, {"how", finding.how}, {"not_used", finding.unused}};
}

// The sea's level at the model's origin; photographs are near it.
double SeaLevel_m(const std::string& geoid, const std::optional<PolygonModel>& model) {
  if (geoid.empty()) return 0;
  if (const std::optional<double> metres = ParseNumber(geoid)) return *metres;
  if (!model || !model->georeference) {
    throw Error("--geoid " + geoid +
                ": the model does not say where it stands (a comment '% origin: LATITUDE LONGITUDE "
                "HEIGHT' in it)");
  }
  return SeaLevelAboveEllipsoid_m(
      geoid, model->georeference->latitude_deg, model->georeference->longitude_deg);
}

int CalibrateLens(LensArguments arguments) {
  arguments.lens.Check();
  const CommonOptions& common = arguments.calibration.common;
  const CalibrationScene scene = ReadCalibrationScene(arguments.calibration);
  arguments.place.geoid_m = SeaLevel_m(arguments.geoid, scene.model);
  arguments.place.Check();
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  size_t num_failed = 0;
  for (const CalibrationPhotograph& photograph : scene.photographs) {
    LensFinding finding;
    try {
      finding = FindLens(photograph, scene.model, arguments);
      if (!common.dry_run) WriteKnownKeys(scene, photograph.name, finding.keys, "lens");
    } catch (const Error& error) {
      ++num_failed;
      finding = {};
      finding.how = error.what();
    }
    if (common.json) {
      json.push_back(JsonFromFinding(photograph.name, finding));
    } else {
      PrintFinding(photograph.name, finding);
    }
  }
  if (common.json) PrintJson({{"photographs", json}});
  return ExitOfCalibration(num_failed, scene.photographs.size());
}

}  // namespace

void AddCalibrateLens(CLI::App* calibrate, int& exit_status) {
  auto arguments = std::make_shared<LensArguments>();
  CLI::App* command = calibrate->add_subcommand(
      "lens", "View angle, place and direction from what digital photographs say of themselves");
  AddCalibrationArguments(command, arguments->calibration);
  command
      ->add_option("--sensor-width",
                   arguments->lens.sensor_width_mm,
                   "of the camera, where the photographs do not tell it")
      ->type_name("MM");
  command
      ->add_option("--declination",
                   arguments->place.declination_deg,
                   "magnetic north, clockwise from true north, for compasses that count from it")
      ->type_name("DEGREES");
  command
      ->add_option("--geoid",
                   arguments->geoid,
                   "the sea's level above the ellipsoid there, if the model's origin is above the "
                   "ellipsoid: photographs count from the sea; or one of GeographicLib's grids, "
                   "egm96-5")
      ->type_name("M|GRID");
  AddExample(command, "groundglass calibrate lens hall");
  command->callback([arguments, &exit_status] {
    exit_status =
        RunWithThreads(arguments->calibration.common, [&] { return CalibrateLens(*arguments); });
  });
}

}  // namespace groundglass
