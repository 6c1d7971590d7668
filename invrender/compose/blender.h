// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/compose/compose_inputs.h"
#include "invrender/inputs/blend_options.h"

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <vector>

namespace groundglass {

// A photograph's part in one texel.
struct Contribution {
  int k = -1;
  double weight = 0;
  bool is_seen = false;
  SurfaceObservation observation;
};

// The four blocks around a texel and their bilinear weights; the texel's own block alone where
// seams are hard.
struct BlockWeights {
  int blocks[4];
  double weights[4];

  BlockWeights(int x, int y, const ChartBlocks& grid, bool is_smooth);
};

// Decides which photographs a texel is mixed of, and finds their places.
class Blender {
 public:
  Blender(const ComposeInputs& inputs, const BlendOptions& options);

  // The photograph (its k) that all blocks around a texel chose; -1 if they differ.
  int ChosenByAll(int x, int y) const;

  // Whether a photograph shows the texel clear of borders.
  bool SeesClear(int k, int x, int y, SurfaceObservation& observation) const;

  // ChosenByAll for the texels of a row that have a face; -1 for the others.
  void ChooseRow(int y, std::vector<int>& chosen) const;

  // Texels of a row that one photograph shows so far from any border that only the first and the
  // last need to be sought in its mask: what lies between is nearer to one of them than they are
  // to a border. Returns how many; 0 if the row has to be gone through texel by texel. Observations
  // are those of the texels' centres.
  static constexpr int kRunTexels = 8;
  int GatherRun(int x,
                int y,
                const std::vector<int>& chosen,
                std::array<SurfaceObservation, kRunTexels>& run) const;

  // The photographs of one texel with weights that sum to 1; empty if none shows it.
  void Gather(int x, int y, std::vector<Contribution>& contributions) const;

  bool IsGood(const std::vector<Contribution>& contributions) const;

  // How many texels lie between a border and the first clean pixel of this photograph.
  uint8_t ReachFromBorder(const SurfaceObservation& observation) const;

 private:
  Contribution& Find(int k,
                     const Eigen::Vector2d& plane_point,
                     int face,
                     std::vector<Contribution>& contributions) const;

  // Those chosen do not see enough of it: the others, the better the more.
  void AddOthers(const Eigen::Vector2d& plane_point,
                 int face,
                 const BlockWeights& blend,
                 double chosen,
                 std::vector<Contribution>& contributions) const;

  double BorderWeight(const Contribution& contribution) const;

  const Chart& chart_;
  const ChartTexels& texels_;
  const std::vector<PreparedPhoto>& photos_;
  const ChartBlocks& blocks_;
  const ChartChoice& choice_;
  const BlendOptions& options_;
  double border_margin_px_;
  std::vector<ChartInCamera> views_;
};

}  // namespace groundglass
