// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/feature_tracks.h"
#include "register/ties/match_patch.h"
#include "register/ties/tie_picture.h"
#include "scene/camera.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <memory>
#include <string>
#include <vector>

namespace groundglass {

// How keypoints that were followed through the photographs (FeatureTrack) become tie points.
struct TrackOptions {
  // A keypoint's standard deviation is hypot(floor_px, scale_share * its scale), measured through
  // true cameras.
  double floor_px = 0.15;
  double scale_share = 0.08;
  // Rays that meet a face further than this from square on say little of where on it.
  double max_angle_deg = 80;
  // A keypoint may lie this share of the picture's width away from where the present cameras see
  // its track's place, and so many of what its camera is uncertain by on top. Generous: a camera
  // that is a little off is what tie points are to mend.
  double gate_share = 0.012;
  double gate_sigmas = 5;
  // How far places lie before or behind their faces as that is judged, sigmas of the model.
  double relief_sigmas = 10;
  // So many tracks are kept in each cell of a grid of so many columns through each photograph.
  int grid_columns = 16;
  int most_per_cell = 4;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "track options: ") const;
};

struct TieOptions {
  // Whether patches of faces are compared at all.
  bool use_patches = true;
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
  // Keypoints count where they have been followed (TieView::followed).
  TrackOptions tracks;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "tie point options: ") const;
};

// A photograph's place in tracks of keypoints.
struct FollowedPhotograph {
  std::shared_ptr<const std::vector<FeatureTrack>> tracks = {};  // nothing: none were followed
  int photograph = -1;                                           // what they call it
  double sigma_px = 0;  // what its camera leaves uncertain, one standard deviation
};

// A photograph as tie points are sought in it.
struct TieView {
  const TiePicture* picture = nullptr;
  Camera camera;  // as it is found so far, for the picture's size
  FollowedPhotograph followed = {};
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
  // A corner of this AprilTag, which may lie off its surveyed place by this, one standard deviation
  // along each axis (model's unit); one photograph may be all that shows it. Else -1.
  int april_tag = -1;
  double survey_sigma = 0;
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
