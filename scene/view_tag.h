// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace groundglass {

// One standard deviation of what was measured, where the field notes say; units as the key's.
struct TagSigmas {
  std::optional<double> position;  // across (x and y each), model's unit
  std::optional<double> height;    // z, model's unit
  std::optional<double> lookat;    // each of i, j, k, model's unit
  std::optional<double> roll_deg;
  std::optional<double> view_angle_deg;
  std::optional<double> aspect;
  std::optional<double> shift;  // each way, fraction of the frame's width
  std::optional<double> k1;

  bool operator==(const TagSigmas&) const = default;
};

// What was written in the field notebook about one photograph: Thorman's view file and this
// project's extension of it. Positions are in `site`, in the model's unit.
struct ViewTag {
  Eigen::Vector3d position_in_site = Eigen::Vector3d::Zero();
  Eigen::Vector3d lookat_in_site = Eigen::Vector3d::UnitX();
  double aspect = 1.5;         // width / height of the frame
  double view_angle_deg = 58;  // horizontal
  double roll_deg = 0;         // positive: camera turned clockwise as its operator sees it
  double shift_x = 0;          // principal point from the frame's centre, right positive,
  double shift_y = 0;          //   down positive; both as a fraction of the frame's WIDTH
  double k1 = 0;               // distortion on normalised coordinates (camera_model.h)
  double k2 = 0;
  double k3 = 0;
  double p1 = 0;
  double p2 = 0;
  TagSigmas sigmas;
  std::string camera;  // photographs with the same name share a lens; may be empty

  bool operator==(const ViewTag&) const = default;
};

// The tag's numbers, in the order of the file format.
enum class TagKey {
  kX,
  kY,
  kZ,
  kI,
  kJ,
  kK,
  kA,
  kV,
  kRoll,
  kShiftX,
  kShiftY,
  kK1,
  kK2,
  kK3,
  kP1,
  kP2
};
constexpr int kNumTagKeys = 16;
constexpr std::array<std::string_view, kNumTagKeys> kTagKeyNames = {"x",
                                                                    "y",
                                                                    "z",
                                                                    "i",
                                                                    "j",
                                                                    "k",
                                                                    "a",
                                                                    "v",
                                                                    "roll",
                                                                    "shift_x",
                                                                    "shift_y",
                                                                    "k1",
                                                                    "k2",
                                                                    "k3",
                                                                    "p1",
                                                                    "p2"};

// The sigmas' names, in the order in which they are written.
struct SigmaKey {
  std::string_view name;
  std::optional<double> TagSigmas::*member;
};
constexpr std::array<SigmaKey, 8> kSigmaKeys = {{
    {"sigma_position", &TagSigmas::position},
    {"sigma_height", &TagSigmas::height},
    {"sigma_lookat", &TagSigmas::lookat},
    {"sigma_roll", &TagSigmas::roll_deg},
    {"sigma_v", &TagSigmas::view_angle_deg},
    {"sigma_a", &TagSigmas::aspect},
    {"sigma_shift", &TagSigmas::shift},
    {"sigma_k1", &TagSigmas::k1},
}};

double GetTagValue(const ViewTag& tag, TagKey key);
void SetTagValue(ViewTag& tag, TagKey key, double value);

// A standard deviation for each of the tag's numbers, indexed by TagKey; 0 where unknown.
using TagDeviations = std::array<double, kNumTagKeys>;

inline Distortion<double> TagDistortion(const ViewTag& tag) {
  return {tag.k1, tag.k2, tag.k3, tag.p1, tag.p2};
}

// The camera that a tag describes, for an image of this size (square pixels or not; formats page).
// The tag must be valid (FindTagFault).
Camera CameraFromTag(const ViewTag& tag, int width_px, int height_px);

// The tag that describes a camera, its look-at point on the optical axis at this distance.
// CameraFromTag(TagFromCamera(c, d), w, h) is c up to rounding; a view straight up or down, which
// no tag can tell, is tilted by 2e-6 rad. Sigmas and name are left empty.
ViewTag TagFromCamera(const Camera& camera, double lookat_distance);

// Why a tag's numbers make no camera, naming the key at fault; empty if they do.
struct TagFault {
  std::string key;
  std::string message;
};
std::optional<TagFault> FindTagFault(const ViewTag& tag);

// Why a number cannot be this standard deviation; empty if it can.
std::string FindSigmaFault(const SigmaKey& key, double sigma);

}  // namespace groundglass
