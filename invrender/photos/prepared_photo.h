// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/inputs/bake_photograph.h"
#include "invrender/inputs/photo_options.h"
#include "invrender/photos/earlier_model.h"
#include "invrender/photos/photo_cache.h"
#include "invrender/photos/visibility_map.h"

#include <Eigen/Dense>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace groundglass {

// How one place on a chart appears in one photograph.
struct SurfaceObservation {
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d px_from_unit = Eigen::Matrix2d::Zero();  // image px for one model unit along the
                                                           // chart's right and down
  double frame_px = 0;                                     // distance to the frame's nearest side
  double border_px = 0;  // distance to the nearest pixel that shows something else
};

// A chart's plane as one camera has it, so that its points need no transformation of their own.
struct ChartInCamera {
  const Chart* chart = nullptr;
  int chart_index = -1;
  bool is_facing = false;  // the camera is on the chart's front
  Eigen::Vector3d origin_in_cam;
  Eigen::Vector3d right_in_cam;
  Eigen::Vector3d down_in_cam;
};

// Throws Error if a picture of width x height pixels is not of the size that its camera is for.
void CheckFitsCamera(const std::filesystem::path& file,
                     int width,
                     int height,
                     const Camera& camera);

// How much is made of a photograph's mask.
struct MaskDetail {
  // How often its sides are halved; masks painted by hand stay as they are.
  int num_halvings = 0;
  // Only what the model says: neither pixels nor masks of what to ignore are read, and
  // PhotoContext::on_face_mask is not called.
  bool is_survey = false;
};

// What all photographs of a bake are prepared with; it must outlive them, but for `options`.
struct PhotoContext {
  const PolygonModel& model;
  const Visibility& visibility;
  const EarlierModel* earlier;  // if the model has changed since; nullptr if not
  const std::vector<int>& chart_of_face;
  const PhotoOptions& options;
  PhotoCache& cache;
  FaceMaskObserver on_face_mask = {};  // gets the automatic mask, if it is set
};

// What of a photograph is to be looked at.
struct PhotoMask {
  int side = 1;    // pixels of the image along a side of the mask's
  Image16 labels;  // face from 1, in the mask's pixels; 0: none
  Image8 ignored;  // not 0: not to be looked at; empty: everything is
};

// A photograph made ready to be looked up: its face mask, how far each pixel is from what must not
// be printed on its face, and its pixels through a cache.
class PreparedPhoto {
 public:
  // Made by PreparePhoto. `index` is the photograph's in the cache.
  PreparedPhoto(const BakePhotograph& photograph,
                int index,
                const PhotoContext& context,
                const PhotoMask& mask);

  ChartInCamera View(const Chart& chart, int chart_index) const;

  // How the photograph shows a point of a face, given in the chart's plane (Chart::PlanePoint,
  // model's unit); nothing if it does not. Exact: near borders of the mask a ray decides.
  std::optional<SurfaceObservation> Observe(const ChartInCamera& view,
                                            const Eigen::Vector2d& plane_point,
                                            int face) const;

  // Where a point of the chart's plane lies in the image, which must be before the camera.
  Eigen::Vector2d Locate(const ChartInCamera& view, const Eigen::Vector2d& plane_point) const;

  // Larger is better: px for one model unit, lowered near borders; 0 is worthless.
  double Quality(const SurfaceObservation& observation) const;

  std::shared_ptr<const PhotoPyramid> Pixels() const { return cache_.Get(index_); }
  // What they take when decoded: a third more than three codes a pixel.
  double NumPixelBytes() const {
    return 0.5 * cache_.bits() * camera_.width_px * camera_.height_px;
  }
  const VisibilityMap& Mask() const { return visibility_map_; }

  // Squared distance from the image's centre, 1 at the corners: vignetting's argument.
  double RadiusSquared(const Eigen::Vector2d& image_px) const {
    return (image_px - half_size_px_).squaredNorm() / half_size_px_.squaredNorm();
  }
  bool IsHandPainted() const { return is_hand_painted_; }
  bool MayTexture(int face) const { return allowed_.empty() || allowed_[face]; }
  // Whether some pixel's centre shows the face; slivers may be seen without.
  bool Shows(int face) const { return is_shown_[face]; }

 private:
  // Painted masks are as coarse as pixels: a face goes half a pixel on beyond the centres of those
  // painted with its number.
  bool IsPaintedBeside(const Eigen::Vector2d& image_px, int face) const;

  bool IsInView(const Eigen::Vector3d& point_in_world) const;

  // From a pixel beside a border a little towards the neighbour that is farthest from it: the pixel
  // itself is mixed of both sides.
  Eigen::Vector2d StepInside(const Eigen::Vector2d& image_px, int chart_index) const;

  VisibilityMap::Pixel PixelAt(const Eigen::Vector2d& image_px) const {
    return visibility_map_.At(static_cast<int>(image_px.x() * mask_from_image_),
                              static_cast<int>(image_px.y() * mask_from_image_));
  }

  const Visibility& visibility_;
  const EarlierModel* earlier_;
  const std::vector<int>& chart_of_face_;
  PhotoCache& cache_;
  int index_;
  Camera camera_;
  Eigen::Vector3d position_in_world_;
  Eigen::Vector2d half_size_px_;
  double weight_ = 1;
  PhotoOptions options_;
  double frame_margin_px_ = 0;
  double tolerance_ = 0;
  bool is_hand_painted_ = false;
  int mask_side_ = 1;           // pixels of the image along a side of the mask's
  double mask_from_image_ = 1;  // 1 / mask_side_
  BorderOptions borders_;       // in the mask's pixels
  std::vector<char> allowed_;
  std::vector<bool> is_shown_;
  VisibilityMap visibility_map_;
};

// Reads the image and the masks; throws Error if they do not fit the camera. Hands the automatic
// face mask to PhotoContext::on_face_mask. `index` is the photograph's in the cache.
PreparedPhoto PreparePhoto(const BakePhotograph& photograph,
                           int index,
                           const PhotoContext& context,
                           const MaskDetail& detail);

}  // namespace groundglass
