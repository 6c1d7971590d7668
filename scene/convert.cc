// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/convert.h"

#include "scene/atomic_file.h"
#include "scene/colmap_io.h"
#include "scene/error.h"
#include "scene/image_io.h"
#include "scene/image_kind.h"
#include "scene/mesh_io.h"
#include "scene/osu_io.h"
#include "scene/photograph_name.h"
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

}  // namespace

ConvertResult ConvertModel(const fs::path& input,
                           const fs::path& output,
                           const ModelOptions& options) {
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
    TexturedModel with_pages = ReadTexturedModel(input);
    textured.faces = std::move(with_pages.faces);
    textured.pages = std::move(with_pages.pages);
  }
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
  const std::vector<fs::path> image_files = ListImageFiles(images);
  std::vector<PhotographName> image_names;
  for (const fs::path& file : image_files) {
    image_names.push_back({ImageStem(file), file.filename().string()});
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
    const std::optional<size_t> found = FindPhotograph(view.stem().string(), image_names);
    if (!found) {
      result.warnings.push_back(Error(view, "left out, since it has no image").what());
      continue;
    }
    const fs::path& image = image_files[*found];
    const ImageSize size = ReadImageSize(image);
    cameras.push_back({image.filename().string(), CameraFromTag(tag, size.width, size.height)});
  }
  if (cameras.empty()) throw Error(input, "no view file here has an image");
  WriteColmapModel(output, cameras);
  result.summary = Count(cameras.size(), "camera") + " in " + output.string();
  return result;
}

}  // namespace groundglass
