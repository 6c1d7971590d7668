// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/search/edge_conflict.h"

#include "scene/check_option.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// What one part of the drawing scores along each of its edges' normals, so that a move of the whole
// picture is a sum of table entries: a straight edge heeds only the move across it.
struct PartScores {
  struct Edge {
    Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
    std::vector<double> nats;  // by offset, from -reach in steps
  };
  std::vector<Edge> edges;
  double observations = 0;
};

PartScores ScorePart(const std::vector<ScoreSample>& samples,
                     const ParameterProjection& projection,
                     double step_px,
                     int num_steps,
                     const ScoreOptions& options) {
  PartScores part;
  for (int i = -num_steps; i <= num_steps; ++i) {
    const std::vector<EdgeScore> scores = ScoreEdges(samples, projection, i * step_px, options);
    part.edges.resize(scores.size());
    for (size_t edge = 0; edge < scores.size(); ++edge) {
      part.edges[edge].normal = scores[edge].normal;
      part.edges[edge].nats.push_back(scores[edge].score.nats);
      if (i == 0) part.observations += scores[edge].score.observations;
    }
  }
  return part;
}

double NatsMoved(const PartScores& part, const Eigen::Vector2d& move_steps, int num_steps) {
  double sum = 0;
  for (const PartScores::Edge& edge : part.edges) {
    const auto offset = std::lround(edge.normal.dot(move_steps));
    sum +=
        edge.nats[static_cast<size_t>(std::clamp<long>(offset, -num_steps, num_steps) + num_steps)];
  }
  return sum;
}

// Where, within reach, the part fits best.
EdgeConflict FindBetterPlace(const PartScores& part, double step_px, int num_steps) {
  const double here = NatsMoved(part, Eigen::Vector2d::Zero(), num_steps);
  EdgeConflict better;
  for (int y = -num_steps; y <= num_steps; ++y) {
    for (int x = -num_steps; x <= num_steps; ++x) {
      const Eigen::Vector2d move_steps(x, y);
      if (move_steps.norm() > num_steps) continue;
      const double gain = NatsMoved(part, move_steps, num_steps) - here;
      if (gain <= better.gain_nats) continue;
      better.gain_nats = gain;
      better.distance_px = step_px * move_steps.norm();
    }
  }
  return better;
}

}  // namespace

void ConflictOptions::Check(const std::string& path) const {
  CheckFromTo(reach_share, 0.001, 0.1, path + "reach_share");
  CheckFromTo(least_distance_share, 0, reach_share, path + "least_distance_share");
  CheckAbove(step_px, 0, path + "step_px");
  CheckAbove(least_gain_nats, 0, path + "least_gain_nats");
  CheckAtLeast(least_observations, 0, path + "least_observations");
  CheckFromTo(least_share, 0, 1, path + "least_share");
}

double ConflictReachPx(double width_px, const ConflictOptions& options) {
  return options.reach_share * width_px;
}

std::optional<EdgeConflict> FindEdgeConflict(const std::vector<ScoreSample>& samples,
                                             const std::vector<ModelEdge>& edges,
                                             const ParameterProjection& projection,
                                             double width_px,
                                             const ScoreOptions& score,
                                             const ConflictOptions& options) {
  const int num_steps =
      static_cast<int>(std::floor(ConflictReachPx(width_px, options) / options.step_px));
  std::optional<EdgeConflict> greatest;
  std::vector<PartScores> parts;
  for (const bool is_coplanar : {false, true}) {
    std::vector<ScoreSample> own;
    for (const ScoreSample& sample : samples) {
      const ModelEdge& edge = edges[static_cast<size_t>(sample.edge)];
      if ((edge.kind == ModelEdge::Kind::kCoplanar) == is_coplanar) own.push_back(sample);
    }
    // Without both parts there is nothing to disagree with.
    double observations = 0;
    for (const ScoreSample& sample : own) observations += sample.observations;
    if (observations < options.least_observations) return std::nullopt;
    parts.push_back(ScorePart(own, projection, options.step_px, num_steps, score));
  }
  for (const bool is_coplanar : {false, true}) {
    EdgeConflict better = FindBetterPlace(parts[is_coplanar ? 1 : 0], options.step_px, num_steps);
    better.is_of_coplanar_edges = is_coplanar;
    if (better.gain_nats < options.least_gain_nats) continue;
    if (better.distance_px < options.least_distance_share * width_px) continue;
    if (!greatest || better.gain_nats > greatest->gain_nats) greatest = better;
  }
  return greatest;
}

}  // namespace groundglass
