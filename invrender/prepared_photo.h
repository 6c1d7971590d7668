// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts.h"
#include "invrender/invrender.h"
#include "invrender/photo_pyramid.h"

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace groundglass {

// How one place on a chart appears in one photograph.
struct Sighting {
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d px_from_unit = Eigen::Matrix2d::Zero();  // image px for one model unit along the
                                                           // chart's right and down
  double border_px = 0;  // distance to the nearest pixel that shows something else
  double quality = 0;    // larger is better; px for one model unit, lowered near borders
};

// A photograph made ready to be looked up: pixels, face mask, and how far each pixel is from what
// must not be printed on its face. About 8 bytes a pixel.
class PreparedPhoto {
 public:
  // Reads the image and the masks; throws Error if they do not fit the camera.
  PreparedPhoto(const BakePhotograph& photograph,
                const PolygonModel& model,
                const Visibility& visibility,
                const std::vector<int>& chart_of_face,
                const BakeOptions& options);

  // How the photograph shows a point of a face; nothing if it does not. Exact: near borders of
  // the mask a ray decides.
  std::optional<Sighting> Sight(const Eigen::Vector3d& point_in_world,
                                const Chart& chart,
                                int chart_index,
                                int face) const;

  Eigen::Array3f Sample(const Sighting& sighting, double footprint, int max_taps) const {
    return pyramid_.Sample(sighting.image_px, sighting.px_from_unit * footprint, max_taps);
  }
  // Squared distance from the image's centre, 1 at the corners: vignetting's argument.
  double RadiusSquared(const Eigen::Vector2d& image_px) const;
  bool MayTexture(int face) const { return allowed_.empty() || allowed_[face]; }

 private:
  // Painted masks are as coarse as pixels: a face goes half a pixel on beyond the centres of those
  // painted with its number.
  bool IsPaintedBeside(const Eigen::Vector2d& image_px, int face) const;

  const Visibility& visibility_;
  const std::vector<int>& chart_of_face_;
  Camera camera_;
  Eigen::Vector3d position_in_world_;
  double weight_ = 1;
  double frame_margin_px_ = 0;
  double border_margin_px_ = 0;
  double tolerance_ = 0;
  bool is_hand_painted_ = false;
  std::vector<char> allowed_;
  PhotoPyramid pyramid_;
  Image16 labels_;  // faces, from 1
  Image8 border_;   // eighths of a pixel to what must not be printed; 0: the pixel itself is that
};

}  // namespace groundglass
