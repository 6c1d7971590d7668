// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"
#include "tests/bench/anchors/castle.h"

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
  std::function<Found(const Castle& castle, const PerturbedStart& start)> align;
};

// ViSP's model-based edge tracker: fixed search ranges, and ranges that shrink.
std::vector<Method> VispMethods();
// OpenCV's rapid; none where OpenCV was built without contrib.
std::vector<Method> OpenCvMethods();
std::vector<Method> GroundglassMethods();

}  // namespace groundglass
