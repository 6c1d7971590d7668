// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"
#include "scene/polygon_model.h"
#include "scene/view_tag.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <string>

namespace groundglass {

// Another reading of the model: point = linear * (point as it was read) + offset.
struct OtherReading {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  bool flips_faces = false;  // its faces' fronts are then what was read as their backs
};

// How a photograph's tag stands to the model.
struct Standpoint {
  Eigen::Vector3d position_in_site = Eigen::Vector3d::Zero();
  std::string bearing;      // where it stands as seen from the model's middle: "SE"
  int face = -1;            // that the optical axis meets; -1: none
  bool shows_front = true;  // of that face
  double distance = 0;      // along the axis to that face, else to the model's middle; model's unit
  double model_share = 0;   // of the frame
  double front_share = 1;   // of what the frame shows of the model
  // How far from the look-at point the axis meets the model, as a share of the distance looked at;
  // 1: it misses, or meets it far from there.
  double lookat_error = 0;
  // The look-at point's distance from the model's surface, as a share of the distance looked at;
  // and whether the model hides it and the faces that it lies on all turn their backs to the
  // camera. Only where the axis does not meet the model near that point.
  double lookat_gap = 0;
  bool looks_at_back = false;
  // The model's extent in the frame: the angle that it takes, as a share of the view angle.
  double apparent_size = 0;
  double size_share = 0;         // of the model's size, the distance looked at
  bool is_inside = false;        // surrounded by the backs of faces
  bool is_below_ground = false;  // under a floor of the model, or far below all of it
};

// The tag must be valid (FindTagFault). The model's other readings are tried on the rays, so that
// one `visibility` serves all of them.
Standpoint FindStandpoint(const Box& bounds,
                          const Visibility& visibility,
                          const PolygonModel& model,
                          const ViewTag& tag,
                          const ImageSize& size,
                          const OtherReading& reading = {});

}  // namespace groundglass
