// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/parameter_projection.h"
#include "register/edges/edge_groups.h"
#include "register/edges/edge_tolerance.h"
#include "scene/feature_edges.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// The model as registration sees it: its lines, and what hides them.
struct EdgeModel {
  explicit EdgeModel(const PolygonModel& model_);

  const PolygonModel& model;
  // FindModelEdges without the borders of a ground that runs far beyond what is built.
  std::vector<ModelEdge> edges;
  // For each edge (FindEdgeTolerances).
  std::vector<EdgeTolerance> tolerances;
  EdgeGroups groups;
  // How far each group's numbers are taken to lie from where the model draws them, model's unit;
  // empty: nowhere else. An edge is seen where the drawn one would be.
  std::vector<Eigen::Vector2d> group_offsets;
  Visibility visibility;
  // How far its edges may lie off, one standard deviation, model's unit (ModelSigma); and how much
  // of that is more than a model of its size has by default, and so more than the widths in pixels
  // of the search, the matching and the score allow for.
  double sigma = 0;
  double looseness = 0;

  // How far its groups take an edge from where the model draws it; and of all edges, empty: none.
  Eigen::Vector3d MoveOf(int edge) const;
  std::vector<Eigen::Vector3d> MovesInWorld() const;
};

// A point on a visible model edge, where the photograph is asked for an edge.
struct EdgeSample {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_in_world = Eigen::Vector3d::UnitX();  // along the edge, unit length
  int edge = -1;                                                  // in EdgeModel::edges
  double along = 0;       // where on the edge: -1 at its start, 1 at its end
  double spacing_px = 0;  // the length of edge it stands for
  double tolerance = 0;   // of its edge, model's unit (EdgeModel)
  double looseness = 0;   // of the model, its unit (EdgeModel)
};

// Samples every spacing_px along the edges that the camera sees; none within 3 px of the frame's
// border. The order follows the edges.
std::vector<EdgeSample> SampleVisibleEdges(const EdgeModel& edge_model,
                                           const Camera& camera,
                                           double margin_px,
                                           double spacing_px);

std::vector<Eigen::Vector3d> PointsOf(const std::vector<EdgeSample>& samples);

// A sample as a camera projects it.
struct ProjectedSample {
  bool is_valid = false;
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // of the projected edge, unit length
  // d (normal . image_px) / d parameters.
  Eigen::Matrix<double, 1, kNumCameraParameters> jacobian =
      Eigen::Matrix<double, 1, kNumCameraParameters>::Zero();
  double px_per_unit = 0;
};
std::vector<ProjectedSample> ProjectSamples(const std::vector<EdgeSample>& samples,
                                            const ParameterProjection& projection);

}  // namespace groundglass
