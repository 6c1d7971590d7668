// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/match_patch.h"
#include "register/ties/tie_picture.h"
#include "scene/camera.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace groundglass {

struct TieOptions {
  // Patches are laid where each photograph, through a grid of this many columns, sees a face.
  int grid_columns = 16;
  int patch_texels = 32;  // a patch's side
  // How far a patch is looked for, texels each way.
  int search_texels = 8;
  // A photograph takes part if its pixels are at least this share as fine on the face as those of
  // the second finest that shows it,
  double least_resolution_share = 0.4;
  // and if it sees the face under no more than this from square on.
  double max_angle_deg = 75;
  // Of those that show a patch, the finest is looked for in the others; where it is not found, the
  // next finest is, and so on, this many in all.
  int num_stars = 2;
  // How many times a photograph is halved for patches whose texels span many of its pixels, plus 1.
  int num_levels = 3;
  PatchMatchOptions match;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "tie point options: ") const;
};

// A photograph as tie points are sought in it.
struct TieView {
  const TiePicture* picture = nullptr;
  Camera camera;  // as it is found so far, for the picture's size
};

// Where one photograph shows a tie point.
struct TieObservation {
  int photograph = -1;
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();  // of its TiePicture
  // Whitens what is left: root_precision * (seen - image_px) is standard normal, 1/px.
  Eigen::Matrix2d root_precision = Eigen::Matrix2d::Identity();
};

// A place on the building that several photographs show: a point of a patch in a face's plane, in
// front of it or behind where the model leaves relief out.
struct TiePoint {
  int face = -1;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();  // on the face
  Eigen::Vector3d normal_in_world = Eigen::Vector3d::UnitZ();
  std::vector<TieObservation> observations;  // two at least, each photograph once
};

// How a photograph's patches were found again in others.
struct TieCounts {
  int num_tried = 0;  // pairs of it and another photograph that shows the same patch
  int num_matched = 0;
};

struct TiePoints {
  std::vector<TiePoint> points;
  std::vector<TieCounts> counts;  // for each photograph
};

// Compares photographs in the planes of the model's faces: patches that two of them see are laid
// flat through their present cameras, where scale and slant no longer matter, and matched. On every
// core; the same whatever their number.
TiePoints FindTiePoints(const PolygonModel& model,
                        const Visibility& visibility,
                        const std::vector<TieView>& views,
                        const TieOptions& options);

// The same between one photograph and each of the others only.
TiePoints FindTiePointsOf(int photograph,
                          const PolygonModel& model,
                          const Visibility& visibility,
                          const std::vector<TieView>& views,
                          const TieOptions& options);

}  // namespace groundglass
