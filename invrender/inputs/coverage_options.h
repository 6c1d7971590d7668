// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <array>
#include <string>

namespace groundglass {

// Where to stand for what no photograph shows (SuggestViewpoint): the first place that works.
struct ViewpointOptions {
  // Feet above the model's lowest point.
  double eye_level_ft = 5.5;
  // Turned so far from the face's normal, about the vertical, degrees; and away from the face by
  // so many times its size.
  std::array<double, 7> turns_deg = {0, 20, -20, 40, -40, 60, -60};
  std::array<double, 3> distances = {1.5, 3, 0.75};
  // Faces seen more obliquely than this (cosine to the normal) show too little.
  double least_cosine = 0.3;
  // Where the backs of faces are met in more of the directions, one stands within the model
  // (BackShare).
  double most_backs = 0.5;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "viewpoint options: ") const;
};

// What is told of how much of each face was covered (FinishCoverage).
struct CoverageOptions {
  // A face of which no more than this share is missing is whole.
  double least_missing_share = 0.01;
  ViewpointOptions viewpoint;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "coverage options: ") const;
};

}  // namespace groundglass
