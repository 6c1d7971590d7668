// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/bake_arguments.h"
#include "cli/commands.h"
#include "scene/formats/output_stages.h"
#include "scene/registration.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// The stages that come after the cameras. `key`: StageKey of what each depends on.
constexpr const char* kTextureStage = "texture";
constexpr const char* kTilesStage = "tiles";
constexpr const char* kStillsStage = "stills";
constexpr const char* kReportStage = "report";

// model.glb, model.obj and its pages, provenance, coverage.json and faces/. On the disk when it
// returns.
BakeResult BakeAndWrite(const Scene& scene,
                        const std::vector<BakePhotograph>& photographs,
                        const BakeArguments& arguments,
                        const BakeOptions& options,
                        const CommonOptions& common,
                        const std::filesystem::path& out,
                        const std::string& key,
                        OutputStages& stages);

// tiles/, if the arguments ask for it and it is not there already.
void EnsureTiles(const Scene& scene,
                 const std::vector<BakePhotograph>& photographs,
                 const BakeArguments& arguments,
                 const std::filesystem::path& out,
                 const std::string& key,
                 OutputStages& stages);

// renders/still_N.jpg, from the model.glb that is there, so that they are the same whether it was
// made now or before. Returns the frame that they have; 0 x 0 if there are none to be made.
ImageSize EnsureStills(const std::vector<Registration>& registrations,
                       int num_stills,
                       const CommonOptions& common,
                       const std::filesystem::path& out,
                       const std::string& key,
                       OutputStages& stages);

}  // namespace groundglass
