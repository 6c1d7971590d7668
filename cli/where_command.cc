// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/answer.h"
#include "cli/commands.h"
#include "cli/model_arguments.h"
#include "cli/option_range.h"
#include "cli/printed_zero.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct WhereArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  fs::path folder;
  fs::path scene;
  std::vector<std::string> points;  // "X,Y,Z"
  std::vector<std::string> photographs;
  std::vector<std::string> pixels;  // "U,V"
  fs::path crops;
  int crop_radius_px = 32;
  bool csv = false;
  PickOptions place;
  SightingOptions sighting;
};

// "1,2,3" as so many numbers.
std::vector<double> ReadNumbers(const std::string& option, const std::string& text, size_t count) {
  std::vector<double> numbers;
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find(',', start), text.size());
    const std::string word(TrimBlanks(std::string_view(text).substr(start, end - start)));
    const std::optional<double> number = ParseNumber(word);
    if (!number || !std::isfinite(*number)) {
      throw Error(option + ": " + Quote(word) + " in " + Quote(text) + " is no number");
    }
    numbers.push_back(*number);
    start = end + 1;
  }
  if (numbers.size() != count) {
    throw Error(option + ": expected " + std::to_string(count) +
                " numbers with commas between, not " + Quote(text));
  }
  return numbers;
}

std::vector<Place> FindPlaces(const WhereArguments& arguments,
                              const Survey& survey,
                              const Visibility& visibility) {
  std::vector<Place> places;
  const auto next = [&] { return static_cast<int>(places.size()); };
  for (const std::string& text : arguments.points) {
    const std::vector<double> site = ReadNumbers("--point", text, 3);
    places.push_back(
        PlaceOnModel(survey, WorldFromSite({site[0], site[1], site[2]}), next(), arguments.place));
  }
  if (arguments.photographs.size() != arguments.pixels.size() &&
      !(arguments.photographs.size() == 1 && !arguments.pixels.empty())) {
    throw Error("--photo and --pixel go together: one --photo for each --pixel, or one for all");
  }
  for (size_t i = 0; i < arguments.pixels.size(); ++i) {
    const std::string& name = arguments.photographs[arguments.photographs.size() == 1 ? 0 : i];
    const std::vector<double> px = ReadNumbers("--pixel", arguments.pixels[i], 2);
    places.push_back(PlaceInPhotograph(survey,
                                       visibility,
                                       FindSurveyPhotograph(survey, name),
                                       {px[0], px[1]},
                                       next(),
                                       arguments.place));
  }
  if (places.empty()) throw Error("nothing is asked for: give --point, or --photo and --pixel");
  return places;
}

// Around each place, in each photograph that shows it: PLACE_NAME.png.
int WriteCrops(const WhereArguments& arguments, const Survey& survey, const Answer& answer) {
  int written = 0;
  for (size_t i = 0; i < answer.places.size(); ++i) {
    for (const Sighting& sighting : answer.sightings[i]) {
      const SurveyPhotograph& photograph = survey.photographs[sighting.photograph];
      if (sighting.state != SightingState::kShown) continue;
      if (photograph.image_file.empty()) {
        throw Error(arguments.folder, "does not hold the photographs: say where with --scene");
      }
      if (!arguments.common.dry_run) {
        WriteSrgb8(arguments.crops / (std::to_string(i + 1) + "_" + photograph.name + ".png"),
                   CropAround(ReadSrgb8(photograph.image_file),
                              *sighting.image_px,
                              arguments.crop_radius_px,
                              8 * arguments.crop_radius_px));
      }
      ++written;
    }
  }
  return written;
}

// One standard deviation of a point, its three axes together.
double SigmaInSpace(const Eigen::Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, covariance.trace()));
}

void PrintPlace(const Survey& survey, const Answer& answer, size_t index) {
  const Place& place = answer.places[index];
  const std::string unit = UnitName(survey.model.unit);
  const Eigen::Vector3d point = SiteFromWorld(place.point_in_world);
  const Eigen::Vector3d sigma = place.Covariance().diagonal().cwiseMax(0).cwiseSqrt();
  std::printf("place %zu: x %.3f  y %.3f  z %.3f %s,  +- %.3f  %.3f  %.3f",
              index + 1,
              ZeroIfRounded(point.x(), 3),
              ZeroIfRounded(point.y(), 3),
              ZeroIfRounded(point.z(), 3),
              unit.c_str(),
              sigma.x(),
              sigma.y(),
              sigma.z());
  if (place.photograph) {
    std::printf("  (camera %.3f, pointing %.3f, model %.3f)",
                SigmaInSpace(place.Covariance(ErrorKind::kCamera)),
                SigmaInSpace(place.Covariance(ErrorKind::kPixel)),
                SigmaInSpace(place.Covariance(ErrorKind::kModel)));
  }
  std::printf("\n");
  if (place.faces.empty()) {
    std::printf("  off the model, %.3f %s from %s\n",
                place.distance_off_model,
                unit.c_str(),
                DescribeFace(survey.model, place.nearest_face).c_str());
  }
  for (const int face : place.faces) {
    // As exact as the lengths: 0.01 of a building's, 0.000001 of a maquette's in metres.
    std::printf("  on %s, %.*f square %s",
                DescribeFace(survey.model, face).c_str(),
                std::max(0, 2 * LengthDecimals(survey.model) - 2),
                ComputeFaceArea(survey.model, face),
                unit.c_str());
    if (const auto texel = TexelSize(survey, face)) {
      std::printf(", texels of %.4f x %.4f %s", (*texel)[0], (*texel)[1], unit.c_str());
    }
    std::printf("\n");
  }
}

void PrintSightings(const Survey& survey, const std::vector<Sighting>& sightings) {
  std::printf("  photograph   x_px     y_px    +-px  distance  angle  pixel there\n");
  for (const Sighting& sighting : sightings) {
    const SurveyPhotograph& photograph = survey.photographs[sighting.photograph];
    if (sighting.state != SightingState::kShown) {
      std::printf("  %-9s  -  %s\n", photograph.name.c_str(), sighting.reason.c_str());
      continue;
    }
    std::printf("  %-9s %8.2f %8.2f %7.2f %9.2f %6.1f  %.4f x %.4f  %s\n",
                photograph.name.c_str(),
                ZeroIfRounded(sighting.image_px->x(), 2),
                ZeroIfRounded(sighting.image_px->y(), 2),
                sighting.camera_sigma_px,
                sighting.distance,
                sighting.angle_deg,
                sighting.pixel_size[0],
                sighting.pixel_size[1],
                photograph.standing.c_str());
  }
  for (const LeftOutPhotograph& left_out : survey.left_out) {
    std::printf("  %-9s  -  %s\n", left_out.name.c_str(), left_out.reason.c_str());
  }
}

void PrintMeasure(const char* what, const Measure& measure, const std::string& unit) {
  std::printf("%s %.3f %s +- %.3f  (camera %.3f, pointing %.3f, model %.3f)\n",
              what,
              measure.value,
              unit.c_str(),
              measure.sigma,
              measure.camera_sigma,
              measure.pixel_sigma,
              measure.model_sigma);
}

int RunWhere(const WhereArguments& arguments) {
  arguments.place.Check();
  arguments.sighting.Check();
  if (arguments.csv && arguments.common.json) throw Error("choose --csv or --json");
  const Survey survey =
      ReadSurvey(arguments.folder, arguments.scene, arguments.model_arguments.Options());
  const Visibility visibility(survey.model);
  const Answer answer = AnswerPlaces(
      survey, visibility, FindPlaces(arguments, survey, visibility), arguments.sighting);
  if (!arguments.crops.empty()) {
    const int written = WriteCrops(arguments, survey, answer);
    std::fprintf(stderr,
                 "groundglass: %s%d crops in %s\n",
                 arguments.common.dry_run ? "would write " : "",
                 written,
                 arguments.crops.c_str());
  }
  if (arguments.common.json) {
    std::fputs(FormatAnswerJson(survey, answer).c_str(), stdout);
  } else if (arguments.csv) {
    std::fputs(FormatAnswerCsv(survey, answer).c_str(), stdout);
  } else {
    for (size_t i = 0; i < answer.places.size(); ++i) {
      PrintPlace(survey, answer, i);
      PrintSightings(survey, answer.sightings[i]);
    }
    const std::string unit = UnitName(survey.model.unit);
    if (answer.distance) PrintMeasure("distance", *answer.distance, unit);
    if (answer.area) PrintMeasure("area", *answer.area, "square " + unit);
  }
  return kExitDone;
}

}  // namespace

void AddWhereCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<WhereArguments>();
  CLI::App* command = app.add_subcommand("where", kWhereSummary);
  command->add_option("folder", arguments->folder, "an output folder, or a scene")->required();
  command->add_option("--scene", arguments->scene, "where the photographs of an output folder are");
  command->add_option("--point", arguments->points, "X,Y,Z: a point, site, the model's unit")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--photo", arguments->photographs, "a photograph that --pixel points into")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--pixel", arguments->pixels, "U,V: where in it, px from its top left corner")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--pointing-sigma",
                   arguments->place.pointing_sigma_px,
                   "how well a pixel is pointed at, one standard deviation, px")
      ->check(Above(0))
      ->capture_default_str();
  command
      ->add_option("--min-angle",
                   arguments->sighting.min_angle_deg,
                   "faces seen flatter than this are grazing, degrees")
      ->check(FromTo(0, 90))
      ->capture_default_str();
  command->add_option("--crops", arguments->crops, "write what is around each place into here");
  command->add_option("--crop-radius", arguments->crop_radius_px, "of the crops, px each way")
      ->check(FromTo(1, 1024))
      ->capture_default_str();
  command->add_flag("--csv", arguments->csv, "a table on stdout");
  AddModelOptions(command, arguments->model_arguments);
  AddCommonOptions(command, arguments->common);
  AddExample(command,
             "groundglass where hall-out --photo s5 --pixel 412.5,633\n"
             "  groundglass where hall-out --point 0,0,4 --point 14,0,4 --json");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return RunWhere(*arguments); });
  });
}

}  // namespace groundglass
