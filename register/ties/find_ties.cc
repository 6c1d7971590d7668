// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/find_ties.h"

#include "register/ties/track_points.h"

#include <iterator>
#include <utility>

namespace groundglass {
namespace {

TiePoints Both(TiePoints one, TiePoints other) {
  if (one.counts.empty()) return other;
  std::move(other.points.begin(), other.points.end(), std::back_inserter(one.points));
  for (size_t i = 0; i < other.counts.size(); ++i) {
    one.counts[i].num_tried += other.counts[i].num_tried;
    one.counts[i].num_matched += other.counts[i].num_matched;
  }
  return one;
}

}  // namespace

TiePoints FindTies(const PolygonModel& model,
                   const Visibility& visibility,
                   const std::vector<TieView>& views,
                   const TieOptions& options) {
  TiePoints patches;
  if (options.use_patches) patches = FindTiePoints(model, visibility, views, options);
  return Both(std::move(patches), PlaceTracks(model, visibility, views, options.tracks));
}

TiePoints FindTiesOf(int photograph,
                     const PolygonModel& model,
                     const Visibility& visibility,
                     const std::vector<TieView>& views,
                     const TieOptions& options) {
  TiePoints patches;
  if (options.use_patches) {
    patches = FindTiePointsOf(photograph, model, visibility, views, options);
  }
  return Both(std::move(patches),
              PlaceTracksOf(photograph, model, visibility, views, options.tracks));
}

}  // namespace groundglass
