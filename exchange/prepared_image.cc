// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/prepared_image.h"

#include "scene/camera_check.h"
#include "scene/error.h"
#include "scene/srgb.h"

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// What the frame shows, on normalised coordinates without distortion.
Eigen::AlignedBox2d ShownBounds(const Camera& camera) {
  constexpr int kSteps = 64;
  Eigen::AlignedBox2d bounds;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = static_cast<double>(camera.width_px) * i / kSteps;
    const double y = static_cast<double>(camera.height_px) * i / kSteps;
    for (const Eigen::Vector2d& border : {Eigen::Vector2d(x, 0),
                                          Eigen::Vector2d(x, camera.height_px),
                                          Eigen::Vector2d(0, y),
                                          Eigen::Vector2d(camera.width_px, y)}) {
      bounds.extend(Eigen::Vector2d(UnprojectToCam(camera, border).head<2>()));
    }
  }
  return bounds;
}

// A frame along one axis: its size and its centre, px, for what reaches from -before to after.
struct Side {
  int size = 0;
  double center = 0;
};
Side FrameSide(double before, double after, bool centred) {
  // What is whole but for rounding gets no pixel more.
  const double length = centred ? 2 * std::max(before, after) : before + after;
  if (!(length > 0 && length <= kLongestSidePx)) {
    throw Error("a picture that shows all that the camera's own shows would be longer than " +
                std::to_string(kLongestSidePx) + " px");
  }
  const int size = std::max(1, static_cast<int>(std::ceil(length - 1e-6)));
  return {size, centred ? size / 2.0 : before};
}

// Linear light of a pixel, nothing beyond the picture.
float LightAt(const Image8& srgb8, int x, int y, int channel) {
  x = std::clamp(x, 0, srgb8.width - 1);
  y = std::clamp(y, 0, srgb8.height - 1);
  return LinearOfSrgb8()[srgb8.At(x, y)[channel]];
}

void SampleBilinear(const Image8& srgb8, const Eigen::Vector2d& image_px, uint8_t* out) {
  const double x = image_px.x() - 0.5;
  const double y = image_px.y() - 0.5;
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const auto fx = static_cast<float>(x - column);
  const auto fy = static_cast<float>(y - row);
  for (int channel = 0; channel < 3; ++channel) {
    const float top = (1 - fx) * LightAt(srgb8, column, row, channel) +
                      fx * LightAt(srgb8, column + 1, row, channel);
    const float bottom = (1 - fx) * LightAt(srgb8, column, row + 1, channel) +
                         fx * LightAt(srgb8, column + 1, row + 1, channel);
    out[channel] = Srgb8FromLinear((1 - fy) * top + fy * bottom);
  }
}

}  // namespace

Camera PreparedCamera(const Camera& camera, const CameraNeeds& needs) {
  const bool bends = needs.no_distortion && camera.IsDistorted();
  const bool squares = needs.square_pixels && camera.focal_x_px != camera.focal_y_px;
  const bool moves = needs.centred && (2 * camera.center_x_px != camera.width_px ||
                                       2 * camera.center_y_px != camera.height_px);
  if (!bends && !squares && !moves) return camera;
  Camera prepared = camera;
  if (needs.no_distortion) {
    prepared.k1 = prepared.k2 = prepared.k3 = prepared.p1 = prepared.p2 = 0;
  }
  if (needs.square_pixels) {
    prepared.focal_x_px = prepared.focal_y_px = std::max(camera.focal_x_px, camera.focal_y_px);
  }
  Eigen::AlignedBox2d bounds = ShownBounds(camera);
  if (!needs.no_distortion && camera.IsDistorted()) {
    // The lens stays, and so does the frame around the principal point.
    bounds = Eigen::AlignedBox2d(
        Eigen::Vector2d(-camera.center_x_px / camera.focal_x_px,
                        -camera.center_y_px / camera.focal_y_px),
        Eigen::Vector2d((camera.width_px - camera.center_x_px) / camera.focal_x_px,
                        (camera.height_px - camera.center_y_px) / camera.focal_y_px));
  }
  const Side across = FrameSide(-bounds.min().x() * prepared.focal_x_px,
                                bounds.max().x() * prepared.focal_x_px,
                                needs.centred);
  const Side down = FrameSide(-bounds.min().y() * prepared.focal_y_px,
                              bounds.max().y() * prepared.focal_y_px,
                              needs.centred);
  prepared.width_px = across.size;
  prepared.height_px = down.size;
  prepared.center_x_px = across.center;
  prepared.center_y_px = down.center;
  return prepared;
}

bool IsSameFrame(const Camera& a, const Camera& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.focal_x_px == b.focal_x_px &&
         a.focal_y_px == b.focal_y_px && a.center_x_px == b.center_x_px &&
         a.center_y_px == b.center_y_px && a.k1 == b.k1 && a.k2 == b.k2 && a.k3 == b.k3 &&
         a.p1 == b.p1 && a.p2 == b.p2;
}

PreparedImage PrepareImage(const Image8& srgb8, const Camera& camera, const Camera& prepared) {
  PreparedImage image;
  image.srgb8 = Image8(prepared.width_px, prepared.height_px, 3);
  image.mask = Image8(prepared.width_px, prepared.height_px, 1);
  tbb::parallel_for(0, prepared.height_px, [&](int y) {
    for (int x = 0; x < prepared.width_px; ++x) {
      const Eigen::Vector3d ray = UnprojectToCam(prepared, {x + 0.5, y + 0.5});
      const auto source_px = ProjectFromCam(camera, ray);
      if (!source_px || !IsInsideFrame(camera, *source_px)) continue;
      SampleBilinear(srgb8, *source_px, image.srgb8.At(x, y));
      *image.mask.At(x, y) = 255;
    }
  });
  return image;
}

}  // namespace groundglass
