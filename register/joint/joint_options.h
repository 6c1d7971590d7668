// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/edges/aligned_sample.h"
#include "register/edges/edge_matches.h"

#include <numbers>
#include <string>

namespace groundglass {

// Lengths are in units of the model's sigma (ModelSigma): 0.03 m for a building.
struct JointOptions {
  // What a model edge lies off in all photographs alike: of its shift as a whole, and of its ends
  // apart from that. The scale of a distribution with long tails (Cauchy), since most edges are
  // where the model has them and a few are far away.
  double common_offset_sigmas = 1;
  double common_turn_sigmas = 1;
  // What a group of edges (EdgeGroups) lies off as one, on top of that: the scale of a distribution
  // of the same kind. A group is moved as one where so many of its edges are seen; of more groups
  // than this, those with the most edges.
  double group_offset_sigmas = 1;
  // Where the upper quartile of what so many groups or more were found to lie off is less than
  // this, the model is that much better than it claims: the scale shrinks in proportion, to no less
  // than the last.
  double usual_group_quartile_sigmas = 0.5;
  int least_groups = 12;
  double least_group_offset_sigmas = 0.3;
  int least_edges_of_group = 3;
  int most_groups = 200;
  double widest_offset_sigmas = 10;  // one sigma of a normal distribution that ends the tails
  // How far the ground lies above or below the model's lowest level, everywhere alike, one sigma.
  // Soil does not follow a model, however well surveyed: counted in no less than the model's
  // default sigma.
  double ground_level_sigmas = 0.1 / 0.03;
  // What is seen of an edge in one photograph only (light, blur, a joint on its sunny side). Long
  // tails here too: Student's t. The size of both parts is found in each scene, between the least
  // and the most: that of the own part from what is left of each edge, that of the shared one as
  // the upper quartile of the displacements, for all modes that move an edge together: each of them
  // (EdgeBias::shared_offset_sigmas) has its part of that.
  EdgeBias own = {0.4, 0.4, 1};
  double own_degrees_of_freedom = 3;
  double least_own_offset_sigmas = 0.002 / 0.03;
  double most_own_offset_sigmas = 0.05 / 0.03;
  double least_shared_offset_sigmas = 0.01 / 0.03;
  double most_shared_offset_sigmas = std::numbers::sqrt3;
  // The part of a prior's variance that is the photograph's own; the rest is its lens', and the
  // same for all photographs of that lens. Slides have a scale, an aspect and a shift of their own.
  double own_k1_share = 0.001;
  double own_view_angle_share = 1;
  double own_aspect_share = 1;
  double own_shift_share = 1;
  // Tie points: what is left of one counts less and less beyond this many of its sigmas (Cauchy).
  double tie_loss_sigmas = 1;
  // How far they lie before or behind their faces: the scale of a distribution with long tails
  // (Cauchy), and one sigma of a normal distribution that ends them. Next to nothing is assumed: a
  // whole wall may be set back from the cornice that the model has, and a prior that pulls all its
  // points to the face bends the cameras (docs/measurements/accuracy.md).
  double relief_sigmas = 0.1;
  double widest_relief_sigmas = 100;
  // Surveyed AprilTags: what a corner lies off its surveyed place counts less and less beyond this
  // many of its sigmas (Cauchy), since a tag may have been moved; a corner in a photograph is no
  // better known than this, and its four share their tag's error, so each one's counts this often.
  double survey_loss_sigmas = 2;
  double least_corner_px = 0.1;
  double shared_survey_factor = 2;
  // A tag is told to be elsewhere if its corners' mean is found this many of its sigmas off.
  double moved_tag_sigmas = 5;
  // How often candidates are chosen anew, and how far from an edge: it shrinks by this factor a
  // round, down to matching.final_range_px. A loose model (EdgeSample::looseness) widens both.
  int num_rounds = 6;
  double start_range_px = 6;
  // Candidates are kept this many times as far away, since the camera moves while they are matched.
  double spare_range = 1.5;
  double shrink = 0.6;
  double min_noise_px = 0.3;
  MatchOptions matching = {.final_range_px = 1.2};

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "joint options: ") const;
};

}  // namespace groundglass
