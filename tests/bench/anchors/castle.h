// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/view_tag.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// ViSP's rendered sequence Castle-simu: 40 frames of 640 x 480 with exact poses, of a tower with a
// yard. ViSP's frame `visp` has y up and metres; `world` has z up and is 100 times as large, so
// that the tower is as high as a house: world = 100 (x, -z, y).
struct Castle {
  std::string cao;     // the model in ViSP's format
  PolygonModel model;  // the same
  struct Frame {
    Image8 grey8;
    ViewTag tag;  // the true one
  };
  std::vector<Frame> frames;
};

// Reads it from `folder` (.../mbt-depth/Castle-simu). Throws Error. The model is chateau.wrl's: all
// polygons of the castle, exact; chateau.cao has five of them and one coordinate off by 3 mm.
Castle ReadCastle(const std::filesystem::path& folder);

// A tag with errors, and one standard deviation of each as stated to Groundglass.
struct PerturbedStart {
  int frame = 0;
  ViewTag tag;
};

// `count` starts, spread over the frames, whose mean vertex error is exactly error_px. Position,
// look-at point and roll err together; the lens is known. The stated sigmas are those with which
// such starts are drawn.
std::vector<PerturbedStart> MakeStarts(const Castle& castle,
                                       double error_px,
                                       int count,
                                       uint64_t seed);

// Mean distance, px, between the faces' corners as two cameras project them, over those inside the
// true frame; 1e6 if the other camera does not see them.
double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found);

constexpr double kWorldPerVisp = 100;
// Rotation: world axes from ViSP's.
Eigen::Matrix3d WorldFromVispAxes();

}  // namespace groundglass
