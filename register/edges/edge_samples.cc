// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_samples.h"

#include "scene/building_bounds.h"
#include "scene/model_sigma.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

namespace {

// Planes that lie less apart were drawn as one. In the model's default sigmas (ModelSigma).
constexpr double kSamePlaneSigmas = 0.25;
// Parallel ones that lie less apart are one wall with its reveals and cornices: 1 m of a building.
constexpr double kAttachedPlaneSigmas = 33;

// A ground that runs far beyond the building ends where its author stopped drawing: no
// photograph shows an edge there.
std::vector<ModelEdge> FindBuiltEdges(const PolygonModel& model) {
  std::vector<ModelEdge> edges = FindModelEdges(model);
  const Box built = ComputeBuildingBounds(model);
  const double margin = built.Diagonal();
  const auto is_far = [&](const Eigen::Vector3d& point) {
    return ((point - built.max).array() > margin).any() ||
           ((built.min - point).array() > margin).any();
  };
  std::erase_if(edges, [&](const ModelEdge& edge) {
    return edge.kind == ModelEdge::Kind::kBoundary && is_far(edge.start_in_world) &&
           is_far(edge.end_in_world);
  });
  return edges;
}

}  // namespace

EdgeModel::EdgeModel(const PolygonModel& model_)
    : model(model_),
      edges(FindBuiltEdges(model_)),
      tolerances(FindEdgeTolerances(model_, edges)),
      visibility(model_),
      sigma(ModelSigma(model_)) {
  const double usual = DefaultModelSigma(model);
  std::vector<bool> on_ground;
  for (const EdgeTolerance& tolerance : tolerances) on_ground.push_back(tolerance.on_ground);
  groups = FindEdgeGroups(
      model, edges, on_ground, kSamePlaneSigmas * usual, kAttachedPlaneSigmas * usual);
  looseness = sigma > usual ? std::sqrt(sigma * sigma - usual * usual) : 0;
}

Eigen::Vector3d EdgeModel::MoveOf(int edge) const {
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  if (group_offsets.empty()) return move;
  for (const EdgeGroupPart& part : groups.of_edge[edge]) {
    move += part.directions * group_offsets[part.group].head(part.directions.cols());
  }
  return move;
}

std::vector<Eigen::Vector3d> EdgeModel::MovesInWorld() const {
  std::vector<Eigen::Vector3d> moves;
  if (group_offsets.empty()) return moves;
  moves.reserve(edges.size());
  for (size_t edge = 0; edge < edges.size(); ++edge) {
    moves.push_back(MoveOf(static_cast<int>(edge)));
  }
  return moves;
}

std::vector<EdgeSample> SampleVisibleEdges(const EdgeModel& edge_model,
                                           const Camera& camera,
                                           double margin_px,
                                           double spacing_px) {
  const std::vector<VisibleSpan> spans = FindVisibleSpans(
      edge_model.model, edge_model.edges, edge_model.visibility, camera, margin_px);
  std::vector<EdgeSample> samples;
  for (const VisibleSpan& span : spans) {
    const Eigen::Vector3d start_in_cam = camera.cam_from_world * span.start_in_world;
    const Eigen::Vector3d end_in_cam = camera.cam_from_world * span.end_in_world;
    const auto start_px = ProjectFromCam(camera, start_in_cam);
    const auto end_px = ProjectFromCam(camera, end_in_cam);
    if (!start_px || !end_px) continue;
    const double length_px = (*end_px - *start_px).norm();
    // Short pieces have no direction of their own, and the ends of long ones meet other lines.
    if (length_px < 2 * spacing_px) continue;
    const int count = static_cast<int>(length_px / spacing_px);
    const Eigen::Vector3d direction = (span.end_in_world - span.start_in_world).normalized();
    const ModelEdge& edge = edge_model.edges[span.edge];
    const double edge_length = (edge.end_in_world - edge.start_in_world).norm();
    const Eigen::Vector3d move = edge_model.MoveOf(span.edge);
    for (int i = 0; i < count; ++i) {
      const double s = (i + 0.5) / count;
      const double t =
          s * start_in_cam.z() / (end_in_cam.z() + s * (start_in_cam.z() - end_in_cam.z()));
      const Eigen::Vector3d point =
          span.start_in_world + t * (span.end_in_world - span.start_in_world);
      const double along = 2 * (point - edge.start_in_world).norm() / edge_length - 1;
      samples.push_back({point + move,
                         direction,
                         span.edge,
                         along,
                         length_px / count,
                         edge_model.tolerances[span.edge].sigma,
                         edge_model.looseness});
    }
  }
  return samples;
}

std::vector<Eigen::Vector3d> PointsOf(const std::vector<EdgeSample>& samples) {
  std::vector<Eigen::Vector3d> points_in_world;
  points_in_world.reserve(samples.size());
  for (const EdgeSample& sample : samples) points_in_world.push_back(sample.point_in_world);
  return points_in_world;
}

std::vector<ProjectedSample> ProjectSamples(const std::vector<EdgeSample>& samples,
                                            const ParameterProjection& projection) {
  std::vector<ProjectedSample> projected(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    const EdgeSample& sample = samples[i];
    const auto here = projection.Project(sample.point_in_world);
    if (!here) continue;
    // A step along the edge of about a pixel gives its direction in the image.
    const auto there_px =
        projection.ImageOf(sample.point_in_world + sample.direction_in_world / here->px_per_unit);
    if (!there_px) continue;
    const Eigen::Vector2d along = *there_px - here->image_px;
    const double length = along.norm();
    if (!(length > 1e-3)) continue;  // seen end on
    projected[i].is_valid = true;
    projected[i].image_px = here->image_px;
    projected[i].normal = {-along.y() / length, along.x() / length};
    projected[i].jacobian = projected[i].normal.transpose() * here->jacobian;
    projected[i].px_per_unit = here->px_per_unit;
  }
  return projected;
}

}  // namespace groundglass
