// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_tolerance.h"

#include "scene/building_bounds.h"
#include "scene/frames.h"
#include "scene/model_sigma.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Creases that turn by more are meant as they are drawn.
constexpr double kSharpestRoundingDeg = 50;
// Wide facets that meet at a shallow angle are roofs more often than roundings. In the model's
// sigmas, as are all lengths here; buildings have 0.03 m.
constexpr double kMostRoundingSigmas = 0.1 / 0.03;
constexpr double kGroundSigmas = 0.07 / 0.03;
constexpr double kGroundToleranceSigmas = 0.01 / 0.03;

// How far a face reaches from an edge of its own.
double WidthFromEdge(const PolygonModel& model, int face, const ModelEdge& edge) {
  const Eigen::Vector3d direction = (edge.end_in_world - edge.start_in_world).normalized();
  double width = 0;
  for (const int point : model.faces[face].points) {
    const Eigen::Vector3d offset = model.points_in_world[point] - edge.start_in_world;
    width = std::max(width, (offset - direction.dot(offset) * direction).norm());
  }
  return width;
}

}  // namespace

std::vector<EdgeTolerance> FindEdgeTolerances(const PolygonModel& model,
                                              const std::vector<ModelEdge>& edges) {
  // However well its edges were surveyed, soil does not follow the model.
  const double sigma = std::max(ModelSigma(model), DefaultModelSigma(model));
  const double lowest = ComputeBuildingBounds(model).min.z();
  const double ground_tolerance = kGroundToleranceSigmas * sigma;

  std::vector<EdgeTolerance> tolerances;
  tolerances.reserve(edges.size());
  for (const ModelEdge& edge : edges) {
    EdgeTolerance of_edge;
    if (edge.kind == ModelEdge::Kind::kBoundary) {
      const double highest_end = std::max(edge.start_in_world.z(), edge.end_in_world.z());
      if (highest_end < lowest + ground_tolerance) of_edge = {kGroundSigmas * sigma, true};
    } else if (edge.kind == ModelEdge::Kind::kCrease && edge.angle_deg <= kSharpestRoundingDeg) {
      const double chord = std::min(WidthFromEdge(model, edge.first_face, edge),
                                    WidthFromEdge(model, edge.second_face, edge));
      of_edge.sigma = std::min(chord / 2 * std::tan(RadiansFromDegrees(edge.angle_deg) / 4),
                               kMostRoundingSigmas * sigma);
    }
    tolerances.push_back(of_edge);
  }
  return tolerances;
}

}  // namespace groundglass
