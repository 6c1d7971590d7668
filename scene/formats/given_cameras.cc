// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/given_cameras.h"

#include "scene/building_bounds.h"
#include "scene/error.h"
#include "scene/formats/image_paths.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

// "a.jpg, b.jpg, c.jpg and 12 more"
std::string ListSome(const std::vector<std::string>& names) {
  constexpr size_t kMost = 5;
  std::string text;
  for (size_t i = 0; i < std::min(kMost, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

// Quarter turns clockwise that bring the file's raster into EXIF's orientation; 0 for the mirrored
// ones, which no camera writes.
int TurnOf(int orientation) {
  switch (orientation) {
    case 3:
      return 2;
    case 6:
      return 1;
    case 8:
      return 3;
    default:
      return 0;
  }
}

// Whether an image of one size is the other scaled, its sides rounded to pixels.
bool IsScaled(const Camera& camera, const ImageSize& size) {
  const double scale = static_cast<double>(size.width) / camera.width_px;
  return std::abs(scale * camera.height_px - size.height) <= 0.5 + scale;
}

}  // namespace

GivenCameras MatchColmapModel(const ColmapFiles& files,
                              const std::vector<std::string>& image_paths) {
  GivenCameras given;
  given.files = {files.cameras_file, files.images_file};
  given.warnings = files.warnings;
  const ImagePathFinder finder(image_paths);
  std::vector<std::string>& strays = given.strays;
  const ColmapReading reading = ReadColmapImages(files);
  for (const NamedCamera& camera : reading.cameras) {
    const std::optional<size_t> image = finder.Find(camera.name);
    if (!image) {
      strays.push_back(camera.name);
      continue;
    }
    const auto [place, is_new] = given.camera_of_image.emplace(*image, camera);
    if (!is_new) {
      given.faults.push_back(Error(files.images_file,
                                   "images " + Quote(place->second.name) + " and " +
                                       Quote(camera.name) + " are both images/" +
                                       image_paths[*image] +
                                       "; lay out images/ in folders as COLMAP had it")
                                 .what());
    }
  }
  std::vector<ColmapFault> stray_faults;
  for (const ColmapFault& fault : reading.faults) {
    const std::optional<size_t> image = fault.name.empty() ? std::nullopt : finder.Find(fault.name);
    if (image) {
      given.faults_of_image[*image].push_back(fault.text);
    } else {
      stray_faults.push_back(fault);
    }
  }
  const std::vector<std::string> told = TellColmapFaults(stray_faults);
  given.warnings.insert(given.warnings.end(), told.begin(), told.end());
  std::vector<std::string> bare;
  for (size_t i = 0; i < image_paths.size(); ++i) {
    if (given.camera_of_image.count(i) == 0 && given.faults_of_image.count(i) == 0)
      bare.push_back(image_paths[i]);
  }
  if (!strays.empty()) {
    given.warnings.push_back(Error(files.images_file,
                                   std::to_string(strays.size()) +
                                       " without a photograph in images/: " + ListSome(strays))
                                 .what());
  }
  if (!bare.empty()) {
    given.warnings.push_back(
        Error(files.images_file,
              std::to_string(bare.size()) +
                  " of the photographs in images/ are not in this model: " + ListSome(bare))
            .what());
  }
  return given;
}

FittedCamera FitCamera(const Camera& camera,
                       const ImageSize& size,
                       const std::filesystem::path& image_file) {
  FittedCamera fitted = {camera, {}};
  // COLMAP numbers the pixels as they lie in the file.
  const int turn = TurnOf(size.orientation);
  const bool is_upright_already = turn % 2 == 1 && IsScaled(camera, size);
  if (turn != 0 && !is_upright_already) {
    fitted.camera = TurnedCamera(camera, turn);
    fitted.change = "turned as the picture's EXIF says, which COLMAP does not look at";
  }
  if (fitted.camera.width_px == size.width && fitted.camera.height_px == size.height) return fitted;
  if (!IsScaled(fitted.camera, size)) {
    throw Error(image_file,
                "is " + SizeText(size.width, size.height) + " pixels, but its camera is for " +
                    SizeText(camera.width_px, camera.height_px) +
                    ", which is another shape; give the pictures that the cameras were found with");
  }
  fitted.change += (fitted.change.empty() ? "" : ", and ") + std::string("scaled from ") +
                   SizeText(fitted.camera.width_px, fitted.camera.height_px) + " to " +
                   SizeText(size.width, size.height) + " pixels";
  fitted.camera = ResizedCamera(fitted.camera, size.width, size.height);
  return fitted;
}

ViewTag TagForModel(const Camera& camera, const PolygonModel& model) {
  double distance = 0;
  if (!model.points_in_world.empty()) {
    distance = (ComputeBuildingBounds(model).Center() - camera.PositionInWorld()).norm();
  }
  return TagFromCamera(camera, distance > 0 ? distance : 1);
}

}  // namespace groundglass
