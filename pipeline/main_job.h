// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake.h"
#include "pipeline/job_observer.h"
#include "pipeline/photograph_selection.h"
#include "pipeline/stage_keys.h"
#include "pipeline/texture_stages.h"
#include "register/register.h"
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What the options of the main job are set to, stage by stage.
struct MainJobTexts {
  OptionTexts registering;
  OptionTexts texture;
  OptionTexts tiles;
  OptionTexts stills;
};

struct MainJobOptions {
  RegisterOptions registering;
  std::optional<Lens> lens;  // of all photographs, where it is known
  BakeOptions baking;        // on_face_mask is not called: the masks go to faces/
  PhotographSelection selection;
  std::string page_format = "jpg";  // of the OBJ's pages: jpg, png, tif or exr; the GLB's are JPEG
  TilesToWrite tiles;
  int num_stills = 4;  // pictures from new viewpoints
  bool report = true;  // report.html

  uint64_t seed = 1988;  // of everything that is drawn by chance; manifest.json has it
  // All the options above as text. A later run into the same folder keeps what was made from the
  // same files with the same texts. Without them it is not known what anything there was made with,
  // and everything is made anew.
  std::optional<MainJobTexts> texts;

  void Check() const;  // throws Error naming the first field out of range
};

struct MainJobResult {
  RegisteredScene registered;
  // Of the model's surface, what has a texture, 0 to 1; nothing if there is no texture.
  std::optional<double> covered_share;
  ImageSize stills;                           // frame of the pictures, px; 0 x 0 if there are none
  std::vector<std::string> selection_faults;  // masks and lines of pairs.csv that cannot be used
  std::vector<std::string> remarks;           // lines for a person on what was not made
  // "STAGE: what went wrong" for each stage that failed once the tags were corrected.
  std::vector<std::string> failures;
};

// The main job: corrects the tags of the scene's photographs and writes them, overlays, the
// textured model, tiles, pictures from new viewpoints and report.html into `out`
// (docs/output-folder.md), which nobody else may use meanwhile. What an earlier run left for other
// inputs is removed. Throws Error for options out of range, a selection that leaves no photograph,
// a folder that holds somebody's files, and where registration cannot be done; what goes wrong
// after that costs its own stage only, and is among the failures.
MainJobResult RunMainJob(const Scene& scene,
                         const std::filesystem::path& out,
                         const MainJobOptions& options = {},
                         const JobObserver& observer = {});

// The stages (kRegisterStage, ...) that an earlier run has left in `out` complete and that
// RunMainJob would keep. Writes nothing. Throws Error for inputs that cannot be read.
std::vector<std::string> FindKeptStages(const Scene& scene,
                                        const std::filesystem::path& out,
                                        const MainJobOptions& options);

}  // namespace groundglass
