// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/add_tracks.h"

#include "register/ties/colmap_matches.h"

#include <memory>
#include <utility>

namespace groundglass {

TieUse::Colmap AddColmapTracks(const EdgeModel& edge_model,
                               const ColmapOptions& options,
                               std::vector<PhotographAlignment>& alignments) {
  std::vector<PhotographAlignment*> used;
  std::vector<ColmapPhotograph> photographs;
  std::vector<Camera> cameras;
  for (PhotographAlignment& alignment : alignments) {
    const AlignedPhotograph& aligned = alignment.aligned;
    if (aligned.found.empty() || !aligned.picture || aligned.picture->Empty()) continue;
    used.push_back(&alignment);
    cameras.push_back(aligned.prior.CameraAt(aligned.whitened));
    photographs.push_back({aligned.picture.get(), cameras.back()});
  }
  const std::vector<std::pair<int, int>> pairs =
      FindCovisiblePairs(edge_model.model, edge_model.visibility, cameras, options.pairs);
  const ColmapMatches found = MatchWithColmap(photographs, pairs, options);
  const auto tracks =
      std::make_shared<const std::vector<FeatureTrack>>(FollowMatches(found.matches));
  for (size_t i = 0; i < used.size(); ++i) {
    const Registration& registration = used[i]->registration;
    // Its uncertainty is in pixels of the photograph, keypoints are in those of the picture.
    const double scale =
        static_cast<double>(photographs[i].picture->width()) / registration.width_px;
    const FollowedPhotograph followed = {
        tracks, static_cast<int>(i), scale * registration.vertex_sigma_px};
    used[i]->aligned.followed = followed;
    if (used[i]->second_best) used[i]->second_best->followed = followed;
  }
  TieUse::Colmap use;
  use.version = found.version;
  use.sha256 = found.sha256;
  use.num_photographs = static_cast<int>(photographs.size());
  use.num_pairs = static_cast<int>(pairs.size());
  use.num_tracks = static_cast<int>(tracks->size());
  return use;
}

}  // namespace groundglass
