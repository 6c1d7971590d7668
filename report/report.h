// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/formats/scene_folder.h"
#include "scene/image.h"

#include <filesystem>
#include <functional>
#include <string>

namespace groundglass {

struct ReportOptions {
  std::string title;  // empty: the scene folder's name, else the output folder's
  // Width of the pictures inside the report, px. Beyond 40 photographs they are half as wide, so
  // that the file stays within what a browser opens.
  int picture_width_px = 760;
  // Draws the edges of the scene's model over a photograph of the camera's size, as measured or as
  // corrected (viewer/overlay.h: MakeEdgeDrawing). Without it photographs are as overlays/ has
  // them.
  std::function<Image8(const Image8& photograph_srgb8, const Camera& camera, bool is_corrected)>
      draw_edges;

  void Check() const;  // throws Error naming the first field out of range
};

// report.html: the whole story of an output folder as one file that opens without a network, for a
// reader who knows the building and not the program. Reads what is there of registration.json,
// coverage.json, manifest.json, overlays/ and renders/ (stills from new viewpoints: .jpg or .png,
// in natural order; films: .mp4, linked). With the scene and options.draw_edges, each photograph is
// shown with the measured and with the corrected edges side by side; without it, as overlays/ has
// it. Error if the folder holds neither registration.json nor coverage.json.
std::string MakeReport(const std::filesystem::path& out_folder,
                       const Scene* scene = nullptr,
                       const ReportOptions& options = {});

}  // namespace groundglass
