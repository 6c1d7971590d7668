// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// Where along a normal the photograph has an edge.
struct EdgeCandidate {
  double offset_px = 0;  // from the sample, along its normal, in the photograph's pixels
  double strength = 0;   // signed: brightness step along the normal, in units of the noise
};

// What the photograph says about edges: gradients in scale space, searched along normals.
class EdgeEvidence {
 public:
  // grey8: 1 channel. ignore: same size, non-zero where the photograph is no evidence; may be
  // empty.
  EdgeEvidence(const Image8& grey8, const Image8& ignore);

  // Subpixel maxima of the gradient along the normal (unit length) within range_px, whose
  // direction lies within gate_deg of the normal; at most max_candidates, the strongest.
  // The wider the range, the coarser the scale that is searched.
  std::vector<EdgeCandidate> FindCandidates(const Eigen::Vector2d& image_px,
                                            const Eigen::Vector2d& normal,
                                            double range_px,
                                            int max_candidates,
                                            double gate_deg) const;

  // The gradient at one scale: level 0 is the photograph's own resolution, each further level has
  // half of it. Values are in units of that level's noise.
  // Optics blur light, not its sRGB code, in which a blurred edge's steepest place lies up to a
  // third of a pixel towards its dark side: edges are found by the code's gradient, where dark
  // and bright ones count alike, and placed by the light's.
  struct Level {
    double scale = 1;       // photograph's pixels per level's pixel
    ImageF gradient;        // 2 channels: x, y
    ImageF light_gradient;  // the same of linear light, in no particular unit
  };
  const Level& AtScale(double px_per_cell) const;

 private:
  std::vector<Level> levels_;
  Image8 ignore_;
};

}  // namespace groundglass
