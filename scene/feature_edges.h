// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/orthographic_view.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// A straight piece of the model's drawing: a border of one face, or the border that two share.
// Borders that only partly coincide (T-junctions) are cut where the other ends.
struct ModelEdge {
  enum class Kind {
    kBoundary,  // one face only
    kCrease,    // two faces at an angle
    kCoplanar,  // two faces in one plane: a change of material or of name
  };
  Eigen::Vector3d start_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_in_world = Eigen::Vector3d::Zero();
  int first_face = -1;
  int second_face = -1;  // -1 for a boundary
  Kind kind = Kind::kBoundary;
  // Angle between the two faces' normals; 0 when coplanar, 180 for a boundary.
  double angle_deg = 180;
};

struct FeatureEdgeOptions {
  // Two faces that meet at less than this are one rounded surface: no line there.
  double min_crease_deg = 10;
  // Borders between coplanar faces count as lines.
  bool coplanar_borders = true;

  void Check() const;  // throws Error naming the first field out of range
};

// All lines that some view may show: shallow creases among them, since they may be silhouettes.
// Order follows the faces, and is the same on every machine.
std::vector<ModelEdge> FindModelEdges(const PolygonModel& model);

// A part of an edge that a camera sees.
struct VisibleSpan {
  int edge = -1;  // in the list of FindModelEdges
  Eigen::Vector3d start_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_in_world = Eigen::Vector3d::Zero();
  bool is_silhouette = false;  // one side of the line is not the model's near surface
};

// Hidden-line removal: the visible spans of all drawn edges, clipped to the frame widened by
// margin_px, their ends found to a fraction of a pixel. Order follows the edges.
std::vector<VisibleSpan> FindVisibleSpans(const PolygonModel& model,
                                          const std::vector<ModelEdge>& edges,
                                          const Visibility& visibility,
                                          const Camera& camera,
                                          double margin_px,
                                          const FeatureEdgeOptions& options = {});
// The same by parallel rays. What lies before view.near_depth hides nothing.
std::vector<VisibleSpan> FindVisibleSpans(const PolygonModel& model,
                                          const std::vector<ModelEdge>& edges,
                                          const Visibility& visibility,
                                          const OrthographicView& view,
                                          double margin_px,
                                          const FeatureEdgeOptions& options = {});

}  // namespace groundglass
