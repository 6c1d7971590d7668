// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/texture_stages.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/textured_model_io.h"
#include "viewer/camera_path.h"
#include "viewer/renderer.h"

namespace groundglass {
namespace fs = std::filesystem;

BakeResult BakeAndWrite(const Scene& scene,
                        const std::vector<BakePhotograph>& photographs,
                        const BakeArguments& arguments,
                        const BakeOptions& options,
                        const CommonOptions& common,
                        const fs::path& out,
                        const std::string& key,
                        OutputStages& stages) {
  const std::string page_extension = "." + arguments.format;
  std::vector<std::string> masks;
  for (const BakePhotograph& photograph : photographs) {
    masks.push_back("faces/" + photograph.name + ".png");
  }
  stages.Begin(kTextureStage, key, masks);
  ConfigureMallocTrimming(arguments);
  BakeOptions with_masks = options;
  with_masks.on_face_mask = FaceMaskWriter(out);
  BakeResult bake =
      BakeTextures(scene.model, photographs, with_masks, MakeProgress(common, "texturing"));
  if (bake.coverage.CoveredShare() == 0) {
    throw Error("none of the " + std::to_string(photographs.size()) +
                " photographs shows the front of a face that is to be textured, so nothing is; "
                "groundglass check SCENE -o DIR draws what the scene's own tags see");
  }
  std::vector<std::string> files = BakeFiles(bake, page_extension);
  files.insert(files.end(), masks.begin(), masks.end());
  stages.Begin(kTextureStage, key, files);
  WriteBake(bake, out, page_extension);
  stages.Finish(kTextureStage);
  return bake;
}

void EnsureTiles(const Scene& scene,
                 const std::vector<BakePhotograph>& photographs,
                 const BakeArguments& arguments,
                 const fs::path& out,
                 const std::string& key,
                 OutputStages& stages) {
  if (!arguments.tiles && !arguments.tile_record) return;
  if (stages.IsComplete(kTilesStage, key)) return;
  std::vector<std::string> files;
  if (arguments.tile_record) files = {"tiles/record.json", "tiles/model.osu"};
  for (const BakePhotograph& photograph : photographs) {
    files.push_back(arguments.tile_record ? "tiles/views/" + photograph.name + ".view"
                                          : "tiles/" + photograph.name + ".tiles");
  }
  stages.Begin(kTilesStage, key, files);
  WriteTilesIfAsked(arguments, scene.model, photographs, out);
  stages.Finish(kTilesStage);
}

ImageSize EnsureStills(const std::vector<Registration>& registrations,
                       int num_stills,
                       const CommonOptions& common,
                       const fs::path& out,
                       const std::string& key,
                       OutputStages& stages) {
  std::vector<Camera> cameras;
  for (const Registration& registration : registrations) {
    if (HasCorrection(registration.verdict)) cameras.push_back(registration.CorrectedCamera());
  }
  if (cameras.size() < 2 || num_stills < 1) return {};
  const ImageSize size = CommonFrame(cameras);
  if (stages.IsComplete(kStillsStage, key)) return size;
  std::vector<std::string> files;
  for (int still = 1; still <= num_stills; ++still) {
    files.push_back("renders/still_" + std::to_string(still) + ".jpg");
  }
  stages.Begin(kStillsStage, key, files);
  const TexturedModel model = ReadTexturedModel(out / "model.glb").textured;
  // From where nobody stood: along the flight through the photographs' viewpoints, midway between
  // them. Twice as many frames as stills: every second one, from the first, lies between
  // viewpoints.
  const std::vector<Camera> flight = MakeFlight(model.model, cameras, 2 * num_stills + 1);
  Renderer renderer(model);
  RenderOptions options;
  options.background = Background::kSky;
  options.supersampling = 2;
  const Progress progress = MakeProgress(common, "rendering");
  for (int still = 0; still < num_stills; ++still) {
    WriteSrgb8(out / files[still], renderer.Render(flight[2 * still + 1], options));
    if (progress) progress(still + 1, num_stills, files[still]);
  }
  stages.Finish(kStillsStage);
  return size;
}

}  // namespace groundglass
