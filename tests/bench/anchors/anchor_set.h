// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/view_tag.h"

#include <cstdint>
#include <string>
#include <vector>

namespace groundglass {

// Pictures of one object with known cameras, which all methods are tried on. ViSP's frame `visp`
// is in metres; `world` has z up and is 100 times as large, so that what lies on a table is as
// large as a house.
struct AnchorSet {
  std::string name;
  PolygonModel model;
  Eigen::Matrix3d world_from_visp = Eigen::Matrix3d::Identity();  // a rotation
  struct Frame {
    Image8 grey8;
    ViewTag tag;  // the true one, lens included; its look-at point at the object's distance
  };
  std::vector<Frame> frames;
  // The least contrast that ViSP takes for an edge, in its own measure.
  double visp_edge_threshold = 10000;
};

constexpr double kWorldPerVisp = 100;
// The set's model in ViSP's .cao format and frame.
std::string FormatCao(const AnchorSet& set);

Camera TrueCamera(const AnchorSet::Frame& frame);

// A tag with errors, and one standard deviation of each as stated to Groundglass.
struct PerturbedStart {
  int frame = 0;
  ViewTag tag;
};

// `count` starts, spread over the frames, whose mean vertex error is exactly error_px. Position,
// look-at point and roll err together; the lens is known. The errors are drawn with base sigmas,
// then scaled to the vertex error, and the stated sigmas are scaled with them: in units of what is
// stated, the errors are standard normal over the starts of a cell.
std::vector<PerturbedStart> MakeStarts(const AnchorSet& set,
                                       double error_px,
                                       int count,
                                       uint64_t seed);

// Mean distance, px, between the faces' corners as two cameras project them, over those inside the
// true frame; 1e6 if the other camera does not see them.
double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found);

}  // namespace groundglass
