// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/search/score.h"
#include "scene/feature_edges.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct ConflictOptions {
  // How far the picture is moved to see whether one part of the drawing fits better elsewhere, and
  // how far it must be moved to count, as shares of its width; and in what steps, px.
  double reach_share = 0.016;
  double least_distance_share = 0.0045;
  double step_px = 1;
  // It must score this much better there, nats; and both parts have this many observations.
  double least_gain_nats = 30;
  double least_observations = 15;
  // A part is taken to be misplaced in the model, and the cameras to be in doubt, where this share
  // of the photographs has a conflict. In fewer of them something else lies beside the edges: a
  // gutter, a shadow, the next row of tiles.
  double least_share = 0.5;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "conflict options: ") const;
};

// The model's drawing has two parts that can be misplaced against each other: the borders between
// coplanar faces (windows, doors and courses drawn onto a wall) and all other edges (the building's
// own corners, eaves and outlines). A camera that one part holds fast, and from which the other
// would fit much better if the picture were moved, is the wrong camera or that of a wrong model.
struct EdgeConflict {
  bool is_of_coplanar_edges = false;  // which part would fit better elsewhere
  double distance_px = 0;             // and how far away
  double gain_nats = 0;               // and by how much
};
// The greater one of the two parts' conflicts, if there is any.
// samples: sorted by edge, with candidates ConflictReachPx further out; edges: the model's;
// width_px: of the picture.
std::optional<EdgeConflict> FindEdgeConflict(const std::vector<ScoreSample>& samples,
                                             const std::vector<ModelEdge>& edges,
                                             const ParameterProjection& projection,
                                             double width_px,
                                             const ScoreOptions& score,
                                             const ConflictOptions& options);

// How much further than for the score FindEdgeConflict needs candidates (spare_px), px.
double ConflictReachPx(double width_px, const ConflictOptions& options);

}  // namespace groundglass
