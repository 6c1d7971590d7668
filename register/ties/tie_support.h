// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/tie_points.h"

#include <string>

namespace groundglass {

struct TieSupportOptions {
  // What a patch that is found again where the cameras expect it speaks for them, nats.
  double match_nats = 3;
  // What one that is sought and not found speaks against them: little, for light, glass and trees
  // hide a wall's detail from a right camera too.
  double miss_nats = 0.1;
  // What is left of a tie point counts less and less beyond this many of its sigmas (Cauchy).
  double loss_sigmas = 2;
  // How far tie points lie before or behind their faces, one standard deviation, sigmas of the
  // model.
  double relief_sigmas = 5;
  // A photograph that is not accepted by itself is refined together with others if so many of its
  // patches are found in them, and this share of those that are sought; or if so many are found
  // where the cameras expect them, and this share of those that are found.
  int least_matches_to_join = 6;
  double least_share_to_join = 0.1;
  double least_agreeing_share_to_join = 0.7;
  // One whose camera keeps less than this share of what its own edges said for it, once it is
  // solved together with others, stays alone: they have pulled it away.
  double least_share_kept = 0.1;
  // Together they count no more often than this: neighbouring patches err together.
  int most_matches = 100;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "tie support options: ") const;
};

// How much the other photographs speak for one photograph's camera.
struct TieSupport {
  double nats = 0;       // of all of them
  int num_tried = 0;     // patches sought in another photograph
  int num_matched = 0;   // and found again
  int num_agreeing = 0;  // and where the cameras expect them
};

// What they count where they are many (TieSupportOptions::most_matches), nats.
double CountedNats(const TieSupport& support, const TieSupportOptions& options);
// How much more they speak for the first than for the second, counted alike.
double CountedLead(const TieSupport& first,
                   const TieSupport& second,
                   const TieSupportOptions& options);

// Whether so much of a photograph is found in others that they may be refined together.
bool MayJoin(const TieSupport& support, const TieSupportOptions& options);

// Each tie point is placed where its rays agree best; what is left is weighed. The photograph's
// camera is on trial, the others' are believed. model_sigma: model's unit.
TieSupport MeasureTieSupport(int photograph,
                             const TiePoints& ties,
                             const std::vector<TieView>& views,
                             double model_sigma,
                             const TieSupportOptions& options);

}  // namespace groundglass
