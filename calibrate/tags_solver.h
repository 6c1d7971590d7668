// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/calibrate_tags.h"
#include "calibrate/seen_tag_cost.h"
#include "scene/camera.h"

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace ceres {
class Problem;
}  // namespace ceres

namespace groundglass {

// What the tags' photograph leaves free.
struct TagsState {
  Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
  Eigen::Vector3d world_origin_in_cam = Eigen::Vector3d::Zero();
  TagLens lens = TagLens::Zero();
  std::vector<Eigen::Vector3d> offsets;

  RigidTransform Pose() const { return {cam_from_world.toRotationMatrix(), world_origin_in_cam}; }
};

struct ImageSizePx {
  int width = 0;
  int height = 0;
};

class TagsSolver {
 public:
  TagsSolver(std::vector<SeenTag> seen,
             const ViewTag& lens,
             const ImageSizePx& size,
             const TagsOptions& options)
      : seen_(std::move(seen)), lens_(lens), size_(size), options_(options) {}

  TagsState Start(const RigidTransform& cam_from_world) const;
  // Improves it; returns half the sum of squares, infinite if the start sees a tag behind it.
  double Minimise(TagsState& state) const;
  Camera CameraOf(const TagsState& state) const;
  // Of the corners from where the state puts them, each axis apart.
  double RmsPx(const TagsState& state) const;
  // The tag with its standard deviations; nothing if they are not determined.
  std::optional<ViewTag> TagOf(const TagsState& state, double cost) const;

 private:
  // Of pose (a turn as Ceres adds it, the translation) and lens.
  static constexpr int kNumFree = 6 + kNumTagLens;
  using Covariance = Eigen::Matrix<double, kNumFree, kNumFree>;

  void AddResiduals(ceres::Problem& problem, TagsState& state) const;
  std::optional<Covariance> FindCovariance(const TagsState& state) const;
  // Position, point on the axis beside the tags, roll and view angle (degrees).
  Eigen::Matrix<double, 8, 1> Numbers(const TagsState& state, double distance) const;

  std::vector<SeenTag> seen_;
  ViewTag lens_;
  ImageSizePx size_;
  TagsOptions options_;
};

}  // namespace groundglass
