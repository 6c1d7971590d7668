// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "ask/survey.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace groundglass {

// What may be wrong about a place. Two places that share a source err together.
enum class ErrorKind {
  kCamera,  // the camera of the photograph that was pointed at; index: which
  kPixel,   // the pointing itself; index: a number of its own
  kModel,   // the model: a face's plane, which moves along its normal (index: the face), or a point
};

struct ErrorSource {
  ErrorKind kind = ErrorKind::kPixel;
  int index = 0;
  // d point_in_world / d what errs, and the covariance of what errs: as many columns, rows.
  Eigen::Matrix<double, 3, Eigen::Dynamic> derivative;
  Eigen::MatrixXd covariance;
};

// A point of the building, and how sure that is.
struct Place {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  // The faces (from 0) that it lies on, the nearest first; at a corner several, none off the model.
  std::vector<int> faces;
  int nearest_face = -1;          // also off the model
  double distance_off_model = 0;  // from that face, model's unit
  // Where it was pointed at, if in a photograph.
  std::optional<int> photograph;  // of the survey
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  std::vector<ErrorSource> sources;  // independent of one another

  // Of point_in_world, from all sources or those of one kind.
  Eigen::Matrix3d Covariance() const;
  Eigen::Matrix3d Covariance(ErrorKind kind) const;
};

struct PickOptions {
  double pointing_sigma_px = 1;  // one standard deviation each way
  // Points nearer to a face than this share of the model's size lie on it.
  double on_face_share = 1e-4;

  void Check() const;  // throws Error naming the first field out of range
};

// Where the ray through this point of a photograph meets the model (monoplotting: a single picture
// and the surface that it shows). Its deviation follows to first order from
//   project(point; camera) = image,  normal . point = offset,
// with the camera's covariance, the pointing's, and the model's sigma along the face's normal.
// index: tells this pointing from others. Throws Error if the ray meets nothing, or only a back.
Place PlaceInPhotograph(const Survey& survey,
                        const Visibility& visibility,
                        int photograph,
                        const Eigen::Vector2d& image_px,
                        int index,
                        const PickOptions& options = {});

// A point that was written down, with the faces that it lies on. Its deviation is the model's sigma
// along each axis if it lies on the model, else none. Throws Error where it is so far from the
// model that it cannot be meant.
Place PlaceOnModel(const Survey& survey,
                   const Eigen::Vector3d& point_in_world,
                   int index,
                   const PickOptions& options = {});

}  // namespace groundglass
