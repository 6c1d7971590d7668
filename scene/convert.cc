// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/convert.h"

#include "scene/atomic_file.h"
#include "scene/colmap_io.h"
#include "scene/error.h"
#include "scene/image_io.h"
#include "scene/mesh_io.h"
#include "scene/osu_io.h"
#include "scene/scene_folder.h"
#include "scene/text.h"
#include "scene/textured_model_io.h"
#include "scene/view_io.h"

#include <algorithm>
#include <map>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::string Count(size_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

// The same lengths, counted in another unit.
void ChangeUnit(LengthUnit unit, PolygonModel& model) {
  const double scale = MetresPerUnit(model.unit) / MetresPerUnit(unit);
  for (Eigen::Vector3d& point : model.points_in_world) point *= scale;
  if (model.sigma) *model.sigma *= scale;
  model.unit = unit;
}

}  // namespace

ConvertResult ConvertModel(const fs::path& input,
                           const fs::path& output,
                           const ModelOptions& options,
                           const std::optional<LengthUnit>& output_unit) {
  const std::string from = LowerCase(input.extension().string());
  const std::string to = LowerCase(output.extension().string());
  if (to != ".osu" && to != ".obj" && to != ".glb") {
    throw Error(output, "a model is written as .osu, .obj or .glb");
  }
  ConvertResult result;
  ModelReading reading = ReadModel(input, options);
  result.warnings = std::move(reading.warnings);
  TexturedModel textured;
  textured.model = std::move(reading.model);
  textured.faces.resize(textured.model.faces.size());
  if (to != ".osu" && (from == ".obj" || from == ".glb" || from == ".gltf")) {
    // The same faces in the same order, with their places on the pages.
    TexturedModel with_pages = ReadTexturedModel(input, options);
    textured.faces = std::move(with_pages.faces);
    textured.pages = std::move(with_pages.pages);
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
  return result;
}

ConvertResult ConvertColmapToViews(const fs::path& input,
                                   const fs::path& output,
                                   double lookat_distance) {
  if (!(lookat_distance > 0)) throw Error("the look-at distance must be above 0");
  const std::vector<NamedCamera> cameras = ReadColmapModel(input);
  std::map<std::string, std::string> name_of_stem;
  for (const NamedCamera& named : cameras) {
    const std::string stem = fs::path(named.name).stem().string();
    const auto [place, is_new] = name_of_stem.emplace(stem, named.name);
    if (!is_new) {
      throw Error(input,
                  "images " + Quote(place->second) + " and " + Quote(named.name) +
                      " would have the same view file");
    }
    const ViewTag tag = TagFromCamera(named.camera, lookat_distance);
    if (const std::optional<TagFault> fault = FindTagFault(tag)) {
      throw Error(input, "image " + Quote(named.name) + ": " + fault->message);
    }
    WriteFileAtomically(output / (stem + ".view"),
                        FormatView(tag, "File: " + stem + ".view\nFrom a COLMAP model."));
  }
  return {Count(cameras.size(), "view file") + " in " + output.string(), {}};
}

ConvertResult ConvertViewsToColmap(const fs::path& input,
                                   const fs::path& output,
                                   const fs::path& images) {
  ConvertResult result;
  std::error_code error;
  if (!fs::is_directory(images, error)) {
    throw Error(images, "no such folder of images, which tell the photographs' sizes");
  }
  std::map<std::string, fs::path> image_of_stem;
  for (const fs::directory_entry& entry : fs::directory_iterator(images)) {
    if (entry.is_regular_file() && entry.path().filename().string().front() != '.') {
      image_of_stem.emplace(entry.path().stem().string(), entry.path());
    }
  }
  std::vector<fs::path> views;
  for (const fs::directory_entry& entry : fs::directory_iterator(input)) {
    if (entry.path().extension() == ".view") views.push_back(entry.path());
  }
  std::sort(views.begin(), views.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.stem().string(), b.stem().string());
  });
  std::vector<NamedCamera> cameras;
  for (const fs::path& view : views) {
    const ViewTag tag = ReadView(view);
    const auto image = image_of_stem.find(view.stem().string());
    if (image == image_of_stem.end()) {
      result.warnings.push_back(Error(view, "left out, since it has no image").what());
      continue;
    }
    const ImageSize size = ReadImageSize(image->second);
    cameras.push_back(
        {image->second.filename().string(), CameraFromTag(tag, size.width, size.height)});
  }
  if (cameras.empty()) throw Error(input, "no view file here has an image");
  WriteColmapModel(output, cameras);
  result.summary = Count(cameras.size(), "camera") + " in " + output.string();
  return result;
}

}  // namespace groundglass
