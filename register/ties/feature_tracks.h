// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <utility>
#include <vector>

namespace groundglass {

// A place that stands out in a photograph, whatever its scale and light (SIFT: Lowe, IJCV 2004).
struct Keypoint {
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();  // of the photograph's TiePicture
  double scale_px = 1;  // one standard deviation of the blur in which it stands out most
};

// Keypoints of two photographs that show the same, as one geometry of the two has it.
struct FeaturePair {
  int first = -1;  // photographs
  int second = -1;
  std::vector<std::pair<int, int>> matches;  // a keypoint of the first, one of the second
};

struct FeatureMatches {
  std::vector<std::vector<Keypoint>> keypoints;  // of each photograph
  std::vector<FeaturePair> pairs;
};

struct TrackedKeypoint {
  int photograph = -1;
  Keypoint keypoint;
};

// Keypoints that show one place: two at least, by photograph, each photograph once.
using FeatureTrack = std::vector<TrackedKeypoint>;

// Follows matches from photograph to photograph. A match that would say that a photograph shows one
// place twice is left out; the pairs with the most matches are heard first, since they are wrong
// the least often. In order of the tracks' first keypoints.
std::vector<FeatureTrack> FollowMatches(const FeatureMatches& matches);

}  // namespace groundglass
