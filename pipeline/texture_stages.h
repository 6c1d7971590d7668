// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake.h"
#include "invrender/tiles1988/tiles.h"
#include "pipeline/job_observer.h"
#include "scene/formats/image_io.h"
#include "scene/formats/output_stages.h"
#include "scene/formats/scene_folder.h"
#include "scene/registration.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// The stages that come after the cameras. `key`: StageKey of what each depends on.
constexpr const char* kTextureStage = "texture";
constexpr const char* kTilesStage = "tiles";
constexpr const char* kStillsStage = "stills";
constexpr const char* kReportStage = "report";

// The texture database of 1988, beside the texture.
struct TilesToWrite {
  enum class Form {
    kNone,
    kTiles,   // NAME.tiles for each photograph
    kRecord,  // the view transformations only: tiles are computed when they are viewed
  };
  Form form = Form::kNone;
  TileOptions options;
};

// model.glb, model.obj and its pages (page_format: jpg, png, tif or exr), provenance, coverage.json
// and faces/ (in place of options.on_face_mask). On the disk when it returns. Error if no
// photograph shows a face that is to be textured.
BakeResult BakeAndWrite(const Scene& scene,
                        const std::vector<BakePhotograph>& photographs,
                        const BakeOptions& options,
                        const std::string& page_format,
                        const std::filesystem::path& out,
                        const std::string& key,
                        OutputStages& stages,
                        const JobObserver& observer = {});

// tiles/, if they are wanted and not there already.
void EnsureTiles(const Scene& scene,
                 const std::vector<BakePhotograph>& photographs,
                 const TilesToWrite& tiles,
                 const std::filesystem::path& out,
                 const std::string& key,
                 OutputStages& stages,
                 const JobObserver& observer = {});

// renders/still_N.jpg, from the model.glb that is there, so that they are the same whether it was
// made now or before. Returns the frame that they have; 0 x 0 if there are none to be made.
ImageSize EnsureStills(const std::vector<Registration>& registrations,
                       int num_stills,
                       const std::filesystem::path& out,
                       const std::string& key,
                       OutputStages& stages,
                       const JobObserver& observer = {});

}  // namespace groundglass
