// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/convert.h"

#include "scene/assumed_unit.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/colmap_names.h"
#include "scene/formats/image_io.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::string Count(size_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

// "4, 12-70 and 31 more": numbers in rising order, of many the first.
std::string ListRanges(const std::vector<int>& numbers) {
  constexpr int kMostRanges = 8;
  std::string list;
  size_t i = 0;
  for (int ranges = 0; i < numbers.size() && ranges < kMostRanges; ++ranges) {
    const size_t first = i;
    while (++i < numbers.size() && numbers[i] == numbers[i - 1] + 1) continue;
    list += (list.empty() ? "" : ", ") + std::to_string(numbers[first]);
    if (i > first + 1) list += "-" + std::to_string(numbers[i - 1]);
  }
  if (i < numbers.size()) list += " and " + std::to_string(numbers.size() - i) + " more";
  return list;
}

// Those of a folder, in the order in which people count; none if it is no folder.
std::vector<fs::path> ListViewFiles(const fs::path& folder) {
  std::vector<fs::path> views;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".view") views.push_back(entry.path());
  }
  std::sort(views.begin(), views.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.stem().string(), b.stem().string());
  });
  return views;
}

}  // namespace

ConvertResult ConvertModel(const fs::path& input,
                           const fs::path& output,
                           const ModelOptions& options,
                           const std::optional<LengthUnit>& output_unit) {
  const std::string to = LowerCase(output.extension().string());
  if (to != ".osu" && to != ".obj" && to != ".glb") {
    // Where the input is none that is read, it is what has to be mended, and reading it says so.
    (void)ReadModel(input, options);
    throw Error(output, "a model is written as .osu, .obj or .glb");
  }
  RequireOtherFile(input, output);
  ConvertResult result;
  TexturedModelReading reading = ReadTexturedModel(input, options, to != ".osu");
  result.warnings = std::move(reading.warnings);
  TexturedModel& textured = reading.textured;
  if (const auto assumed = DescribeAssumedUnit(input, textured.model)) {
    result.warnings.push_back(*assumed);
  }
  if (output_unit) ChangeUnit(*output_unit, textured.model);
  if (to == ".osu") {
    WriteFileAtomically(output, FormatOsu(textured.model));
  } else if (to == ".glb") {
    WriteGlb(output, textured);
  } else if (textured.pages.empty()) {
    WriteFileAtomically(output, FormatObj(textured.model));
  } else {
    WriteTexturedObj(output, textured);
  }
  result.summary = Count(textured.model.points_in_world.size(), "point") + ", " +
                   Count(textured.model.faces.size(), "face") + ", " +
                   Count(textured.pages.size(), "texture page") + " in " + output.string();
  result.faces_left_out = std::move(reading.left_out);
  if (!result.faces_left_out.empty()) {
    result.summary += "; " + Count(result.faces_left_out.size(), "face") +
                      " left out: " + ListRanges(result.faces_left_out);
  }
  return result;
}

ConvertResult ConvertColmapToViews(const fs::path& input,
                                   const fs::path& output,
                                   double lookat_distance) {
  if (!(lookat_distance > 0)) throw Error("the look-at distance must be above 0");
  const std::optional<ColmapFiles> files = FindColmapModel(input);
  if (!files) throw Error(input, "no COLMAP model here");
  const ColmapReading reading = ReadColmapImages(*files);
  const std::vector<NamedCamera>& cameras = reading.cameras;
  std::vector<std::string> images;
  for (const NamedCamera& named : cameras) images.push_back(named.name);
  const std::vector<std::string> names = NamePhotographs(images);
  // All are made before the first is written, so that a fault leaves nothing half done.
  std::map<std::string, size_t> image_of_name;
  std::vector<FileToWrite> view_files;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const auto [place, is_new] = image_of_name.emplace(names[i], i);
    if (!is_new) {
      throw Error(input,
                  "images " + Quote(images[place->second]) + " and " + Quote(images[i]) +
                      " would have the same view file");
    }
    const ViewTag tag = TagFromCamera(cameras[i].camera, lookat_distance);
    if (const std::optional<TagFault> fault = FindTagFault(tag)) {
      throw Error(input, "image " + Quote(images[i]) + ": " + fault->message);
    }
    view_files.push_back(
        {output / (names[i] + ".view"),
         FormatView(tag,
                    "File: " + names[i] + ".view\nFrom a COLMAP model, image " + images[i] + ".")});
  }
  WriteFilesAtomically(view_files);
  std::vector<std::string> warnings = files->warnings;
  const std::vector<std::string> faults = TellColmapFaults(reading.faults);
  warnings.insert(warnings.end(), faults.begin(), faults.end());
  return {Count(cameras.size(), "view file") + " in " + output.string(), warnings};
}

ViewCameras ReadViewCameras(const fs::path& input, const fs::path& given_images) {
  ViewCameras result;
  std::vector<fs::path> views = ListViewFiles(input);
  const bool is_scene = views.empty();
  if (is_scene) views = ListViewFiles(input / "views");
  if (views.empty()) {
    throw Error(input,
                "holds no cameras: no view files, no COLMAP model, no fSpy projects, and it is no "
                "output folder");
  }
  result.images = given_images;
  if (given_images.empty()) {
    const fs::path folder = fs::absolute(input / ".").lexically_normal().parent_path();
    result.images = (is_scene ? folder : folder.parent_path()) / "images";
  }
  const fs::path& images = result.images;
  std::error_code error;
  if (!fs::is_directory(images, error)) {
    throw Error(images,
                "no such folder of images, which tell the photographs' sizes; say with --images "
                "where they are");
  }
  const std::vector<std::string> image_paths = ListImagePaths(images);
  const std::vector<std::string> names = NamePhotographs(image_paths);
  std::vector<PhotographName> image_names;
  for (size_t i = 0; i < image_paths.size(); ++i) {
    image_names.push_back({names[i], image_paths[i]});
  }
  for (const fs::path& view : views) {
    const ViewTag tag = ReadView(view);
    const std::optional<size_t> found = FindPhotograph(view.stem().string(), image_names);
    if (!found) {
      result.warnings.push_back(Error(view, "left out, since it has no image").what());
      continue;
    }
    const ImageSize size = ReadImageSize(images / image_paths[*found]);
    result.cameras.push_back({image_paths[*found], CameraFromTag(tag, size.width, size.height)});
  }
  if (result.cameras.empty())
    throw Error(input, "no view file here has an image in " + images.string());
  return result;
}

ConvertResult ConvertViewsToColmap(const fs::path& input,
                                   const fs::path& output,
                                   const fs::path& images) {
  ViewCameras views = ReadViewCameras(input, images);
  WriteColmapModel(output, views.cameras);
  std::vector<std::string> names;
  for (const NamedCamera& named : views.cameras) names.push_back(named.name);
  for (std::string& warning : TellNamesWithBlanks(output, names)) {
    views.warnings.push_back(std::move(warning));
  }
  return {Count(views.cameras.size(), "camera") + " in " + output.string(),
          std::move(views.warnings)};
}

}  // namespace groundglass
