// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "pipeline/texture_stages.h"

#include "invrender/bake_output.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/progress.h"
#include "viewer/camera_path.h"
#include "viewer/renderer.h"

namespace groundglass {
namespace {

namespace fs = std::filesystem;

void WriteTilesOrRecord(const TilesToWrite& tiles,
                        const PolygonModel& model,
                        std::vector<BakePhotograph> photographs,
                        const fs::path& folder) {
  const std::vector<std::vector<int>> faces =
      PairFacesWithPhotographs(model, photographs, tiles.options);
  for (size_t i = 0; i < photographs.size(); ++i) photographs[i].faces = faces[i];
  if (tiles.form == TilesToWrite::Form::kRecord) {
    WriteTileRecord(folder, {model, photographs, tiles.options});
    return;
  }
  const Visibility visibility(model);
  for (const BakePhotograph& photograph : photographs) {
    if (photograph.faces->empty()) continue;
    WriteTiles(folder / (photograph.name + ".tiles"), [&](const TileSink& append) {
      MakeTiles(model, visibility, photograph, *photograph.faces, tiles.options, append);
    });
  }
}

}  // namespace

BakeResult BakeAndWrite(const Scene& scene,
                        const std::vector<BakePhotograph>& photographs,
                        const BakeOptions& options,
                        const std::string& page_format,
                        const fs::path& out,
                        const std::string& key,
                        OutputStages& stages,
                        const JobObserver& observer) {
  const std::string page_extension = "." + page_format;
  std::vector<std::string> masks;
  for (const BakePhotograph& photograph : photographs) {
    masks.push_back("faces/" + photograph.name + ".png");
  }
  stages.Begin(kTextureStage, key, masks);
  BakeOptions with_masks = options;
  with_masks.on_face_mask = FaceMaskWriter(out);
  BakeResult bake =
      BakeTextures(scene.model, photographs, with_masks, observer.Begin(kTextureStage));
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
                 const TilesToWrite& tiles,
                 const fs::path& out,
                 const std::string& key,
                 OutputStages& stages,
                 const JobObserver& observer) {
  if (tiles.form == TilesToWrite::Form::kNone) return;
  if (stages.IsComplete(kTilesStage, key)) {
    observer.Keep(kTilesStage);
    return;
  }
  const bool is_record = tiles.form == TilesToWrite::Form::kRecord;
  std::vector<std::string> files;
  if (is_record) files = {"tiles/record.json", "tiles/model.osu"};
  for (const BakePhotograph& photograph : photographs) {
    files.push_back(is_record ? "tiles/views/" + photograph.name + ".view"
                              : "tiles/" + photograph.name + ".tiles");
  }
  stages.Begin(kTilesStage, key, files);
  observer.Begin(kTilesStage);
  WriteTilesOrRecord(tiles, scene.model, photographs, out / "tiles");
  stages.Finish(kTilesStage);
}

ImageSize EnsureStills(const std::vector<Registration>& registrations,
                       int num_stills,
                       const fs::path& out,
                       const std::string& key,
                       OutputStages& stages,
                       const JobObserver& observer) {
  std::vector<Camera> cameras;
  for (const Registration& registration : registrations) {
    if (HasCorrection(registration.verdict)) cameras.push_back(registration.CorrectedCamera());
  }
  if (cameras.size() < 2 || num_stills < 1) return {};
  const ImageSize size = CommonFrame(cameras);
  if (stages.IsComplete(kStillsStage, key)) {
    observer.Keep(kStillsStage);
    return size;
  }
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
  const Progress progress = observer.Begin(kStillsStage);
  ProgressCounter steps(progress, num_stills);
  for (int still = 0; still < num_stills; ++still) {
    WriteSrgb8(out / files[still], renderer.Render(flight[2 * still + 1], options));
    steps.Tell(files[still]);
  }
  stages.Finish(kStillsStage);
  return size;
}

}  // namespace groundglass
