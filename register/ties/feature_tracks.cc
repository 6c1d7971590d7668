// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/feature_tracks.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <unordered_map>

namespace groundglass {
namespace {

// Keypoints of all photographs, numbered through, in sets that grow together (union-find).
class KeypointSets {
 public:
  explicit KeypointSets(const FeatureMatches& matches) {
    for (size_t photograph = 0; photograph < matches.keypoints.size(); ++photograph) {
      first_of_photograph_.push_back(photograph_of_.size());
      photograph_of_.insert(
          photograph_of_.end(), matches.keypoints[photograph].size(), static_cast<int>(photograph));
    }
    parents_.resize(photograph_of_.size());
    std::iota(parents_.begin(), parents_.end(), size_t{0});
  }

  size_t NumberOf(int photograph, int keypoint) const {
    return first_of_photograph_[photograph] + keypoint;
  }

  // The least number of its set.
  size_t RootOf(size_t number) {
    while (parents_[number] != number) {
      parents_[number] = parents_[parents_[number]];
      number = parents_[number];
    }
    return number;
  }

  // Unless a photograph would be in the set twice.
  void Join(size_t one, size_t other) {
    const auto [root, child] = std::minmax({RootOf(one), RootOf(other)});
    if (root == child) return;
    const std::vector<int> photographs = PhotographsOf(root);
    const std::vector<int> others = PhotographsOf(child);
    std::vector<int> both;
    std::merge(photographs.begin(),
               photographs.end(),
               others.begin(),
               others.end(),
               std::back_inserter(both));
    if (std::adjacent_find(both.begin(), both.end()) != both.end()) return;
    parents_[child] = root;
    photographs_of_root_.erase(child);
    photographs_of_root_[root] = std::move(both);
  }

  // Whether the set has more keypoints than its root.
  bool IsShared(size_t root) const { return photographs_of_root_.count(root) > 0; }

 private:
  std::vector<int> PhotographsOf(size_t root) const {
    const auto found = photographs_of_root_.find(root);
    return found == photographs_of_root_.end() ? std::vector<int>{photograph_of_[root]}
                                               : found->second;
  }

  std::vector<size_t> first_of_photograph_;
  std::vector<int> photograph_of_;
  std::vector<size_t> parents_;
  // Of sets of more than one, sorted: most keypoints have no match.
  std::unordered_map<size_t, std::vector<int>> photographs_of_root_;
};

}  // namespace

std::vector<FeatureTrack> FollowMatches(const FeatureMatches& matches) {
  KeypointSets sets(matches);
  std::vector<const FeaturePair*> pairs;
  for (const FeaturePair& pair : matches.pairs) pairs.push_back(&pair);
  std::stable_sort(pairs.begin(), pairs.end(), [](const FeaturePair* a, const FeaturePair* b) {
    return a->matches.size() > b->matches.size();
  });
  for (const FeaturePair* pair : pairs) {
    for (const auto& [first, second] : pair->matches) {
      sets.Join(sets.NumberOf(pair->first, first), sets.NumberOf(pair->second, second));
    }
  }
  // Numbers run by photograph, and a set's root is its least number: it comes first.
  std::vector<FeatureTrack> tracks;
  std::unordered_map<size_t, size_t> track_of_root;
  for (int photograph = 0; photograph < static_cast<int>(matches.keypoints.size()); ++photograph) {
    const std::vector<Keypoint>& keypoints = matches.keypoints[photograph];
    for (int k = 0; k < static_cast<int>(keypoints.size()); ++k) {
      const size_t root = sets.RootOf(sets.NumberOf(photograph, k));
      if (!sets.IsShared(root)) continue;
      const auto [track, is_new] = track_of_root.emplace(root, tracks.size());
      if (is_new) tracks.emplace_back();
      tracks[track->second].push_back({photograph, keypoints[k]});
    }
  }
  return tracks;
}

}  // namespace groundglass
