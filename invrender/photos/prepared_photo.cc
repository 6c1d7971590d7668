// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/prepared_photo.h"

#include "invrender/photos/border_distance.h"
#include "invrender/photos/face_mask.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/ignore_mask.h"
#include "scene/formats/image_io.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// 0 below `low`, 1 above `high`, smooth between.
double SmoothStep(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// The camera of a picture with pixels `side` times as long, of which the last ones may reach over
// the frame.
Camera CoarserCamera(const Camera& camera, int side) {
  Camera coarse = camera;
  coarse.width_px = (camera.width_px + side - 1) / side;
  coarse.height_px = (camera.height_px + side - 1) / side;
  coarse.focal_x_px /= side;
  coarse.focal_y_px /= side;
  coarse.center_x_px /= side;
  coarse.center_y_px /= side;
  return coarse;
}

BorderOptions OfCoarserMask(BorderOptions options, int side) {
  options.crease_bonus_px /= side;
  return options;
}

// Coarse pixels are ignored if any of theirs are.
Image8 Coarser(const Image8& ignored, int side) {
  if (ignored.Empty() || side == 1) return ignored;
  Image8 coarse((ignored.width + side - 1) / side, (ignored.height + side - 1) / side, 1);
  for (int y = 0; y < ignored.height; ++y) {
    for (int x = 0; x < ignored.width; ++x) {
      *coarse.At(x / side, y / side) |= *ignored.At(x, y);
    }
  }
  return coarse;
}

// What is not to be looked at: the slide's mount, and what the photograph's own mask says. Empty:
// everything is.
Image8 FindIgnored(const BakePhotograph& photograph, int index, const PhotoContext& context) {
  Image8 ignored;
  if (context.options.detect_mount) {
    context.cache.Get(index, [&](const PhotoPyramid& whole) {
      const MountOptions& mount = context.options.mount;
      ignored =
          whole.bits() == 16 ? FindMount(whole.Full16(), mount) : FindMount(whole.Full(), mount);
    });
  }
  if (photograph.mask_file) {
    Image8 mask = ReadIgnoreMask(*photograph.mask_file,
                                 {photograph.camera.width_px, photograph.camera.height_px});
    if (ignored.Empty()) return mask;
    for (size_t i = 0; i < mask.values.size(); ++i) ignored.values[i] |= mask.values[i];
  }
  return ignored;
}

// The automatic mask, in pixels `side` times as long as the image's.
Image16 MakeLabels(const BakePhotograph& photograph, const PhotoContext& context, int side) {
  const Camera camera = CoarserCamera(photograph.camera, side);
  if (context.earlier) return context.earlier->MakeFaceMask(camera);
  return MakeFaceMask(context.model, context.visibility, camera);
}

// The mask as a person painted it.
Image16 ReadPaintedLabels(const BakePhotograph& photograph, const PolygonModel& model) {
  const Image16 numbers = ReadLabels(*photograph.faces_file);
  CheckFitsCamera(*photograph.faces_file, numbers.width, numbers.height, photograph.camera);
  return LabelsFromNumbers(model, numbers, *photograph.faces_file);
}

}  // namespace

void CheckFitsCamera(const std::filesystem::path& file,
                     int width,
                     int height,
                     const Camera& camera) {
  if (width == camera.width_px && height == camera.height_px) return;
  const auto text = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  throw Error(file,
              "is " + text(width, height) + " px, but its camera is for " +
                  text(camera.width_px, camera.height_px));
}

PreparedPhoto::PreparedPhoto(const BakePhotograph& photograph,
                             int index,
                             const PhotoContext& context,
                             const PhotoMask& mask)
    : visibility_(context.visibility),
      earlier_(context.earlier),
      chart_of_face_(context.chart_of_face),
      cache_(context.cache),
      index_(index),
      camera_(photograph.camera),
      position_in_world_(photograph.camera.PositionInWorld()),
      half_size_px_(photograph.camera.width_px / 2.0, photograph.camera.height_px / 2.0),
      weight_(photograph.weight),
      options_(context.options),
      frame_margin_px_(std::max(1.0, options_.frame_margin * photograph.camera.width_px)),
      tolerance_(visibility_.DefaultTolerance()),
      is_hand_painted_(photograph.faces_file.has_value()),
      mask_side_(mask.side),
      mask_from_image_(1.0 / mask_side_),
      borders_(OfCoarserMask(options_.borders, mask_side_)) {
  const size_t num_faces = context.model.faces.size();
  if (photograph.faces) {
    allowed_.assign(num_faces, 0);
    for (const int face : *photograph.faces) allowed_.at(face) = 1;
  }
  // Farther than this from a border, distance no longer matters.
  const double clear_px = options_.border_margin_px + options_.quality.border_clear_px;
  const double farthest_px =
      std::max((clear_px - 0.5) / mask_side_ + 0.5, 3 + borders_.crease_bonus_px) + 1;
  visibility_map_ =
      VisibilityMap(mask.labels,
                    ComputeBorderDistance(context.model,
                                          CoarserCamera(camera_, mask_side_),
                                          mask.labels,
                                          chart_of_face_,
                                          mask.ignored,
                                          borders_),
                    std::min(kFarthestBorder, static_cast<int>(farthest_px * kBorderStepsPerPx)));
  is_shown_ = visibility_map_.ShownFaces(num_faces);
}

PreparedPhoto PreparePhoto(const BakePhotograph& photograph,
                           int index,
                           const PhotoContext& context,
                           const MaskDetail& detail) {
  const ImageSize size = ReadImageSize(photograph.image_file);
  CheckFitsCamera(photograph.image_file, size.width, size.height, photograph.camera);
  const bool is_asked_for = context.on_face_mask && !detail.is_survey;
  PhotoMask mask;
  if (!photograph.faces_file) mask.side = 1 << detail.num_halvings;
  if (is_asked_for) {
    mask.labels = MakeLabels(photograph, context, 1);
    context.on_face_mask(photograph, NumbersFromLabels(context.model, mask.labels));
  }
  if (photograph.faces_file) {
    mask.labels = ReadPaintedLabels(photograph, context.model);
  } else if (mask.side > 1 || !is_asked_for) {
    mask.labels = MakeLabels(photograph, context, mask.side);
  }
  if (!detail.is_survey) {
    mask.ignored = Coarser(FindIgnored(photograph, index, context), mask.side);
  }
  return {photograph, index, context, mask};
}

ChartInCamera PreparedPhoto::View(const Chart& chart, int chart_index) const {
  const RigidTransform& cam_from_world = camera_.cam_from_world;
  ChartInCamera view;
  view.chart = &chart;
  view.chart_index = chart_index;
  view.is_facing = (position_in_world_ - chart.origin_in_world).dot(chart.normal_in_world) > 0;
  view.origin_in_cam = cam_from_world * chart.origin_in_world;
  view.right_in_cam = cam_from_world.rotation * chart.right_in_world;
  view.down_in_cam = cam_from_world.rotation * chart.down_in_world;
  return view;
}

bool PreparedPhoto::IsPaintedBeside(const Eigen::Vector2d& image_px, int face) const {
  const int x0 = static_cast<int>(std::floor(image_px.x() - 0.5));
  const int y0 = static_cast<int>(std::floor(image_px.y() - 0.5));
  for (int y = std::max(0, y0); y <= std::min(visibility_map_.height() - 1, y0 + 1); ++y) {
    for (int x = std::max(0, x0); x <= std::min(visibility_map_.width() - 1, x0 + 1); ++x) {
      const VisibilityMap::Pixel pixel = visibility_map_.At(x, y);
      if (pixel.label == face + 1 && pixel.border != 0) return true;
    }
  }
  return false;
}

bool PreparedPhoto::IsInView(const Eigen::Vector3d& point_in_world) const {
  return earlier_ ? earlier_->Shows(position_in_world_, point_in_world)
                  : visibility_.IsClear(position_in_world_, point_in_world, tolerance_);
}

Eigen::Vector2d PreparedPhoto::StepInside(const Eigen::Vector2d& image_px, int chart_index) const {
  const int x = static_cast<int>(image_px.x() * mask_from_image_);
  const int y = static_cast<int>(image_px.y() * mask_from_image_);
  int most = visibility_map_.At(x, y).border;
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  for (int j = std::max(0, y - 1); j <= std::min(visibility_map_.height() - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(visibility_map_.width() - 1, x + 1); ++i) {
      const VisibilityMap::Pixel pixel = visibility_map_.At(i, j);
      if (pixel.label == 0 || chart_of_face_[pixel.label - 1] != chart_index) continue;
      if (pixel.border <= most) continue;
      most = pixel.border;
      step = Eigen::Vector2d(i - x, j - y);
    }
  }
  return options_.step_inside_px * step;
}

std::optional<SurfaceObservation> PreparedPhoto::Observe(const ChartInCamera& view,
                                                         const Eigen::Vector2d& plane_point,
                                                         int face) const {
  if (!view.is_facing || !MayTexture(face)) return std::nullopt;
  const Eigen::Vector3d in_cam =
      view.origin_in_cam + plane_point.x() * view.right_in_cam + plane_point.y() * view.down_in_cam;
  const auto image_px = ProjectFromCam(camera_, in_cam);
  if (!image_px) return std::nullopt;
  SurfaceObservation observation;
  observation.image_px = *image_px;
  observation.frame_px = std::min({image_px->x(),
                                   image_px->y(),
                                   camera_.width_px - image_px->x(),
                                   camera_.height_px - image_px->y()});
  if (!(observation.frame_px >= frame_margin_px_)) return std::nullopt;
  const VisibilityMap::Pixel pixel = PixelAt(*image_px);
  const double border_px = pixel.border / kBorderStepsPerPx;  // of the mask
  const bool is_own = pixel.label != 0 && chart_of_face_[pixel.label - 1] == view.chart_index;
  if (is_hand_painted_) {
    const bool is_painted = pixel.label == face + 1;
    if (is_painted ? border_px == 0 : !IsPaintedBeside(*image_px, face)) return std::nullopt;
  } else if (border_px < 1.5 + borders_.crease_bonus_px) {
    // The pixel's centre does not speak for its whole: ask for the very point.
    if (border_px == 0 && is_own) return std::nullopt;  // ignored
    const Eigen::Vector3d point_in_world = view.chart->origin_in_world +
                                           plane_point.x() * view.chart->right_in_world +
                                           plane_point.y() * view.chart->down_in_world;
    if (!IsInView(point_in_world)) return std::nullopt;
  } else if (!is_own) {
    return std::nullopt;
  }
  // 0 also half a pixel beside what was painted; in a coarse mask, of the pixel's nearest point.
  observation.border_px = is_own ? std::max(0.0, (border_px - 0.5) * mask_side_ + 0.5) : 0;
  if (is_own && border_px < 1 + borders_.crease_bonus_px) {
    observation.image_px += StepInside(*image_px, view.chart_index);
  }

  // d(image) / d(point), through the distortion.
  const Eigen::Vector2d n = in_cam.hnormalized();
  Eigen::Matrix<double, 2, 3> n_from_cam;
  n_from_cam << 1, 0, -n.x(), 0, 1, -n.y();
  n_from_cam /= in_cam.z();
  Eigen::Matrix2d n_from_plane;
  n_from_plane.col(0) = n_from_cam * view.right_in_cam;
  n_from_plane.col(1) = n_from_cam * view.down_in_cam;
  observation.px_from_unit = ImageFromNormalisedDerivative(camera_, n) * n_from_plane;
  return observation;
}

Eigen::Vector2d PreparedPhoto::Locate(const ChartInCamera& view,
                                      const Eigen::Vector2d& plane_point) const {
  const Eigen::Vector3d in_cam =
      view.origin_in_cam + plane_point.x() * view.right_in_cam + plane_point.y() * view.down_in_cam;
  return ImageFromNormalised(camera_, in_cam.hnormalized());
}

double PreparedPhoto::Quality(const SurfaceObservation& observation) const {
  // Resolution: the worse direction counts more, since its blur is what the eye sees.
  const double sum = observation.px_from_unit.squaredNorm();
  const double det = std::abs(observation.px_from_unit.determinant());
  const double root = std::sqrt(std::max(0.0, sum * sum - 4 * det * det));
  const double large = std::sqrt((sum + root) / 2);
  const double small = large > 0 ? det / large : 0;
  const double resolution = std::sqrt(small * std::sqrt(det));  // small^(3/4) large^(1/4)
  const QualityOptions& quality = options_.quality;
  const double margin_px = options_.border_margin_px;
  const double border = quality.least_at_border + SmoothStep(margin_px - quality.border_ramp_px,
                                                             margin_px + quality.border_clear_px,
                                                             observation.border_px);
  const double ramp_px = quality.frame_ramp_share * camera_.width_px;
  const double frame =
      quality.least_at_frame + (1 - quality.least_at_frame) * SmoothStep(frame_margin_px_,
                                                                         frame_margin_px_ + ramp_px,
                                                                         observation.frame_px);
  return weight_ * resolution * border * frame;
}

}  // namespace groundglass
