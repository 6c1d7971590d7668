// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"
#include "register/best_elsewhere.h"
#include "register/ties/tie_points.h"
#include "register/ties/tie_support.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace groundglass {

// The photographs that are refined together.
struct PhotographSet {
  std::vector<PhotographAlignment*> alignments;
  std::vector<AlignedPhotograph> photographs;
  std::vector<CameraAlone> alone;  // the camera that each started with
  // How far the common solution has found groups of edges from where the model has them.
  std::vector<Eigen::Vector3d> edge_moves_in_world;

  bool Holds(const PhotographAlignment& alignment) const {
    return std::find(alignments.begin(), alignments.end(), &alignment) != alignments.end();
  }
  void Add(PhotographAlignment& alignment, const AlignedPhotograph& photograph, double nats) {
    alignments.push_back(&alignment);
    photographs.push_back(photograph);
    alone.push_back({photograph.whitened, nats});
  }
  void TakeOut(size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    alignments.erase(alignments.begin() + at);
    photographs.erase(photographs.begin() + at);
    alone.erase(alone.begin() + at);
  }
};

TieView ViewOf(const AlignedPhotograph& photograph);
std::vector<TieView> ViewsOf(const std::vector<AlignedPhotograph>& photographs);

// How much other photographs speak for a camera; `skip`: the photograph's own place among them.
TieSupport SupportFor(const AlignedPhotograph& photograph,
                      const std::vector<TieView>& others,
                      std::optional<size_t> skip,
                      const EdgeModel& edge_model,
                      const RegisterOptions& options);

// edge_moves_in_world: where the model's edges are taken to be (none: as they are drawn).
AlignmentScore ScoreOf(const AlignedPhotograph& photograph,
                       const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                       const ScoreOptions& options);

// What edges and the tag say for a camera, as far as that can be compared with its second-best one.
double NatsFor(const AlignedPhotograph& photograph, const AlignmentScore& score);

// With the model's edges where each photograph by itself took them to be.
double NatsAlone(const AlignedPhotograph& photograph,
                 const EdgeModel& edge_model,
                 const ScoreOptions& options);

}  // namespace groundglass
