// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/slide.h"

#include "datasets-synthetic/noise.h"
#include "scene/formats/image_io.h"
#include "scene/frames.h"
#include "scene/srgb.h"

#include <opencv2/imgproc.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Silver grains clump: noise with a short correlation and unit deviation, 3 channels that share
// most of it.
cv::Mat MakeGrain(int width, int height, uint64_t seed) {
  cv::Mat grain(height, width, CV_32FC3);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double shared = NormalOf(HashOf(seed, x, y, 3));
      for (int c = 0; c < 3; ++c) {
        grain.at<cv::Vec3f>(y, x)[c] =
            static_cast<float>(0.8 * shared + 0.6 * NormalOf(HashOf(seed, x, y, c)));
      }
    }
  });
  constexpr double kClump = 0.6;  // px
  cv::GaussianBlur(grain, grain, {5, 5}, kClump, kClump, cv::BORDER_REFLECT);
  // The blur has lowered the deviation by the root of its kernel's sum of squares, in both ways.
  const cv::Mat kernel = cv::getGaussianKernel(5, kClump, CV_64F);
  grain /= kernel.dot(kernel);
  return grain;
}

// A kernel of odd size from how much of each of its pixels a shape covers, by 8 x 8 samples of
// `is_inside`, symmetric about the centre so that nothing moves.
template <typename Inside>
cv::Mat KernelOf(double reach_px, const Inside& is_inside) {
  constexpr int kSamplesAcross = 8;
  const int half = static_cast<int>(std::ceil(reach_px));
  cv::Mat kernel(2 * half + 1, 2 * half + 1, CV_32F);
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      int count = 0;
      for (int j = 0; j < kSamplesAcross; ++j) {
        for (int i = 0; i < kSamplesAcross; ++i) {
          count +=
              is_inside(x + (i + 0.5) / kSamplesAcross - 0.5, y + (j + 0.5) / kSamplesAcross - 0.5);
        }
      }
      kernel.at<float>(y + half, x + half) = static_cast<float>(count);
    }
  }
  return kernel / cv::sum(kernel)[0];
}

cv::Mat DiscKernel(double radius_px) {
  return KernelOf(radius_px + 0.5,
                  [&](double x, double y) { return std::hypot(x, y) <= radius_px; });
}

// A line one pixel wide.
cv::Mat MotionKernel(double length_px, double angle_deg) {
  const double angle = RadiansFromDegrees(angle_deg);
  return KernelOf(length_px / 2 + 1, [&](double x, double y) {
    const double along = std::cos(angle) * x + std::sin(angle) * y;
    const double across = -std::sin(angle) * x + std::cos(angle) * y;
    return std::abs(along) <= length_px / 2 && std::abs(across) <= 0.5;
  });
}

}  // namespace

Eigen::Vector2d SlideTransform::ScanFromIdeal(const Eigen::Vector2d& ideal_px,
                                              int width_px,
                                              int height_px) const {
  const Eigen::Vector2d center(width_px / 2.0, height_px / 2.0);
  const double turn = RadiansFromDegrees(turn_deg);
  const Eigen::Vector2d offset = ideal_px - center;
  const Eigen::Vector2d turned(std::cos(turn) * offset.x() - std::sin(turn) * offset.y(),
                               std::sin(turn) * offset.x() + std::cos(turn) * offset.y());
  return center + Eigen::Vector2d(shift_x_px + scale * (1 + anisotropy / 2) * turned.x(),
                                  shift_y_px + scale * (1 - anisotropy / 2) * turned.y());
}

Camera FoldInSlide(const Camera& ideal, const SlideTransform& slide) {
  Camera camera = ideal;
  const double turn = RadiansFromDegrees(slide.turn_deg);
  RigidTransform turned_from_cam;
  turned_from_cam.rotation << std::cos(turn), -std::sin(turn), 0,  //
      std::sin(turn), std::cos(turn), 0,                           //
      0, 0, 1;
  camera.cam_from_world = turned_from_cam * ideal.cam_from_world;
  camera.focal_x_px *= slide.scale * (1 + slide.anisotropy / 2);
  camera.focal_y_px *= slide.scale * (1 - slide.anisotropy / 2);
  camera.center_x_px += slide.shift_x_px;
  camera.center_y_px += slide.shift_y_px;
  return camera;
}

ImageF DevelopPhotograph(ImageF radiance,
                         const Camera& camera,
                         const Photometry& photometry,
                         uint64_t seed) {
  const int width = radiance.width;
  const int height = radiance.height;
  cv::Mat picture(height, width, CV_32FC3, radiance.values.data());
  const double exposure = std::exp2(photometry.exposure_stops);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double tangent_x = (x + 0.5 - width / 2.0) / camera.focal_x_px;
      const double tangent_y = (y + 0.5 - height / 2.0) / camera.focal_y_px;
      const double cosine_squared = 1 / (1 + tangent_x * tangent_x + tangent_y * tangent_y);
      const double falloff = std::lerp(1.0, cosine_squared * cosine_squared, photometry.vignetting);
      for (int c = 0; c < 3; ++c) {
        float& value = radiance.At(x, y)[c];
        value = static_cast<float>(value * exposure * falloff * photometry.white_balance[c]);
      }
    }
  });
  if (photometry.motion_px > 0) {
    const cv::Mat kernel = MotionKernel(photometry.motion_px, photometry.motion_deg);
    cv::filter2D(picture, picture, -1, kernel, {-1, -1}, 0, cv::BORDER_REFLECT);
  }
  if (photometry.defocus_px > 0) {
    const cv::Mat kernel = DiscKernel(photometry.defocus_px);
    cv::filter2D(picture, picture, -1, kernel, {-1, -1}, 0, cv::BORDER_REFLECT);
  }
  if (photometry.blur_px > 0) {
    cv::GaussianBlur(
        picture, picture, {0, 0}, photometry.blur_px, photometry.blur_px, cv::BORDER_REFLECT);
  }
  cv::Mat grain;
  if (photometry.grain > 0) grain = MakeGrain(width, height, seed);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        float& value = radiance.At(x, y)[c];
        double encoded = SrgbFromLinear(std::clamp(value, 0.0f, 1.0f));
        if (!grain.empty()) {
          // Grain is strongest in the middle tones.
          const double strength = photometry.grain * (0.4 + 2.4 * encoded * (1 - encoded));
          encoded += strength * grain.at<cv::Vec3f>(y, x)[c];
        }
        value = static_cast<float>(std::clamp(encoded, 0.0, 1.0));
      }
    }
  });
  return radiance;
}

Image8 QuantiseSrgb8(const ImageF& encoded) {
  Image8 srgb8(encoded.width, encoded.height, encoded.channels);
  std::transform(
      encoded.values.begin(), encoded.values.end(), srgb8.values.begin(), [](float value) {
        return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
      });
  return srgb8;
}

}  // namespace groundglass
