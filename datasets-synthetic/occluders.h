// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/synthetic_world.h"

#include <string>
#include <utility>
#include <vector>

namespace groundglass {

// What stands in the way and is in no model, by its number in masks_occ (plus kLargeModelOffset
// where the model has as many faces).
enum OccluderCode {
  kPerson = 250,
  kTree = 251,
  kSign = 252,
  kLamp = 253,
  kCar = 254,
  kMount = 255
};
constexpr int kLargeModelOffset = 65000;
// The code's name in truth.json.
const std::vector<std::pair<int, std::string>>& OccluderNames();

// How many there are. Trees, lamps and signs stay where they are; cars and people come and go.
struct OccluderCounts {
  int trees = 0;
  int lamps = 0;
  int signs = 0;
  double cars = 0;    // mean for a photograph
  double people = 0;  // mean for a photograph
};

// The site as its photographers found it, in `world`.
struct OccluderSite {
  Eigen::Vector2d low, high;  // the building's extent on the ground
  double radius = 150;        // of the plaza about its centre
  // The paved square, at height 0; beyond it the lawn lies lower (kLawnHeight).
  Eigen::Vector2d plaza_low = Eigen::Vector2d::Constant(-150);
  Eigen::Vector2d plaza_high = Eigen::Vector2d::Constant(150);
  std::vector<Eigen::Vector3d> camera_positions;
};

// Trees, lamps and signs around the building: out of its walls, and off the photographers' feet.
void AddStandingOccluders(WorldBuilder& builder,
                          const OccluderSite& site,
                          const OccluderCounts& counts,
                          uint64_t seed);

// Cars and people who happened to be there for one photograph, mostly before the camera.
void AddPassingOccluders(WorldBuilder& builder,
                         const OccluderSite& site,
                         const Eigen::Vector3d& camera_position,
                         const Eigen::Vector3d& camera_forward,
                         const OccluderCounts& counts,
                         uint64_t seed);

}  // namespace groundglass
