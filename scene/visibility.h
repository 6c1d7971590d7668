// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <memory>
#include <optional>

namespace groundglass {

// The one engine that answers "what is visible from here", on Embree's BVH over the model's faces.
// Hidden-line removal, face masks and texel visibility all ask it. Faces hide what is behind them
// from both of their sides. Safe to call from many threads.
class Visibility {
 public:
  explicit Visibility(const PolygonModel& model);
  ~Visibility();
  Visibility(Visibility&&) noexcept;
  Visibility& operator=(Visibility&&) noexcept;

  struct Hit {
    int face = -1;         // in the model, from 0
    double distance = 0;   // in the model's unit
    bool is_front = true;  // the ray met the face's front
  };
  // The first face along a ray; direction of unit length. Hits nearer than min_distance and
  // beyond max_distance do not count.
  std::optional<Hit> FirstHit(const Eigen::Vector3d& origin_in_world,
                              const Eigen::Vector3d& direction_in_world,
                              double min_distance = 0,
                              double max_distance = 1e30) const;

  // True if no face stands between the two points, but for those within `tolerance` (model's unit)
  // of the target, which are its own surface.
  bool IsClear(const Eigen::Vector3d& from_in_world,
               const Eigen::Vector3d& target_in_world,
               double tolerance) const;

  // The face that each pixel's centre shows, from 1; 0 where there is none, or where the face's
  // back is seen. width x height x 1.
  Image16 FaceLabels(const Camera& camera) const;

  // A tolerance that suits the model: 1e-4 of its size.
  double DefaultTolerance() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace groundglass
