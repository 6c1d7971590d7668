// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "tests/bench/anchors/anchor_set.h"

#include <functional>
#include <string>
#include <vector>

namespace groundglass {

// One way to get from a start to a camera. The camera is the start's if the method gave up.
struct Method {
  std::string family;   // "ViSP", "OpenCV", "Groundglass": the best setting of a family counts
  std::string setting;  // "range 16"
  struct Found {
    Camera camera;
    bool is_accepted = true;  // only Groundglass judges itself
  };
  std::function<Found(const PerturbedStart& start)> align;
};

// The methods hold on to the set, which must outlive them.

// ViSP's model-based edge tracker: fixed search ranges, and ranges that shrink.
std::vector<Method> VispMethods(const AnchorSet& set);
// OpenCV's rapid; none where OpenCV was built without contrib.
std::vector<Method> OpenCvMethods(const AnchorSet& set);
std::vector<Method> GroundglassMethods(const AnchorSet& set);

}  // namespace groundglass
