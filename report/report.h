// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/formats/scene_folder.h"

#include <Eigen/Dense>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace groundglass {

struct ReportOptions {
  std::string title;           // empty: the scene folder's name, else the output folder's
  int picture_width_px = 960;  // of the pictures inside the report, at most
  // The edges of the scene's model as a camera of the photograph's size sees them, as lines of
  // image points, px (viewer/overlay.h: MakeEdgeFinding). Without it photographs are as overlays/
  // has them.
  std::function<std::vector<std::vector<Eigen::Vector2d>>(const Camera& camera)> find_edges;
  // What the page may weigh. Pictures are as large as fits; the model to turn is taken in if its
  // pages, reduced if they must be, leave it below a half.
  int max_megabytes = 20;

  void Check() const;  // throws Error naming the first field out of range
};

// report.html: the whole story of an output folder as one file that opens without a network, for a
// reader who knows the building and not the program. Reads what is there of registration.json,
// coverage.json, manifest.json, overlays/ and renders/ (stills from new viewpoints: .jpg or .png,
// in natural order; films: .mp4, linked). With the scene and options.find_edges, each photograph
// can be wiped between the measured edges, the corrected ones and itself; without it, it is as
// overlays/ has it. Error if the folder holds neither registration.json nor coverage.json.
std::string MakeReport(const std::filesystem::path& out_folder,
                       const Scene* scene = nullptr,
                       const ReportOptions& options = {});

}  // namespace groundglass
