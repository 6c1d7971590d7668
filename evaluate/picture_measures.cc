// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/picture_measures.h"

#include "scene/error.h"
#include "scene/srgb.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Of encoded values.
cv::Mat LumaOf(const cv::Mat& rgb) {
  cv::Mat luma;
  cv::transform(rgb, luma, cv::Matx13f(kLumaWeights.data()));
  return luma;
}

// The structural similarity index at each pixel (Wang, Bovik, Sheikh and Simoncelli 2004, eq. 13).
cv::Mat SsimMap(const cv::Mat& a, const cv::Mat& b) {
  constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
  constexpr double kC2 = (0.03 * 255) * (0.03 * 255);
  const auto blurred = [](const cv::Mat& image) {
    cv::Mat result;
    cv::GaussianBlur(image, result, {11, 11}, 1.5, 1.5, cv::BORDER_REFLECT);
    return result;
  };
  const cv::Mat mean_a = blurred(a);
  const cv::Mat mean_b = blurred(b);
  const cv::Mat variance_a = blurred(a.mul(a)) - mean_a.mul(mean_a);
  const cv::Mat variance_b = blurred(b.mul(b)) - mean_b.mul(mean_b);
  const cv::Mat covariance = blurred(a.mul(b)) - mean_a.mul(mean_b);
  const cv::Mat numerator = (2 * mean_a.mul(mean_b) + kC1).mul(2 * covariance + kC2);
  const cv::Mat denominator =
      (mean_a.mul(mean_a) + mean_b.mul(mean_b) + kC1).mul(variance_a + variance_b + kC2);
  cv::Mat map;
  cv::divide(numerator, denominator, map);
  return map;
}

void CheckSameSize(int width, int height, int other_width, int other_height, const char* what) {
  if (width == other_width && height == other_height) return;
  throw Error(std::string(what) + " is " + std::to_string(other_width) + "x" +
              std::to_string(other_height) + ", expected " + std::to_string(width) + "x" +
              std::to_string(height) + " as the true picture");
}

}  // namespace

PictureErrors ComparePictures(const Image8& true_srgb8,
                              const Image8& rendered_srgb8,
                              const Image16& labels,
                              const Image8& covered) {
  const int width = true_srgb8.width;
  const int height = true_srgb8.height;
  CheckSameSize(width, height, rendered_srgb8.width, rendered_srgb8.height, "the rendered picture");
  CheckSameSize(width, height, labels.width, labels.height, "the face mask");
  if (!covered.Empty()) {
    CheckSameSize(width, height, covered.width, covered.height, "the coverage mask");
  }
  const auto is_covered = [&](int x, int y) { return covered.Empty() || *covered.At(x, y) != 0; };

  PictureErrors errors;
  long num_covered = 0;
  std::array<double, 3> true_times_rendered = {0, 0, 0};
  std::array<double, 3> rendered_squared = {0, 0, 0};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (*labels.At(x, y) == 0) continue;
      ++errors.num_pixels;
      if (!is_covered(x, y)) continue;
      ++num_covered;
      for (int c = 0; c < 3; ++c) {
        const double rendered = rendered_srgb8.At(x, y)[c];
        true_times_rendered[c] += rendered * true_srgb8.At(x, y)[c];
        rendered_squared[c] += rendered * rendered;
      }
    }
  }
  if (errors.num_pixels == 0) throw Error("the face mask shows no face of the model");
  errors.coverage = static_cast<double>(num_covered) / static_cast<double>(errors.num_pixels);
  for (int c = 0; c < 3; ++c) {
    if (rendered_squared[c] > 0) errors.gain[c] = true_times_rendered[c] / rendered_squared[c];
  }

  cv::Mat expected(height, width, CV_32FC3);
  cv::Mat found(height, width, CV_32FC3);
  double squared_error = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      auto& expected_pixel = expected.at<cv::Vec3f>(y, x);
      auto& found_pixel = found.at<cv::Vec3f>(y, x);
      const bool shows_model = *labels.At(x, y) != 0;
      for (int c = 0; c < 3; ++c) {
        expected_pixel[c] = true_srgb8.At(x, y)[c];
        found_pixel[c] = expected_pixel[c];
        if (!shows_model) continue;
        const double value = is_covered(x, y) ? errors.gain[c] * rendered_srgb8.At(x, y)[c] : 0.0;
        found_pixel[c] = static_cast<float>(std::min(value, 255.0));
        const double difference = found_pixel[c] - expected_pixel[c];
        squared_error += difference * difference;
      }
    }
  }
  const double mean_squared = squared_error / (3.0 * static_cast<double>(errors.num_pixels));
  errors.psnr_db =
      mean_squared > 0 ? std::min(99.0, 10 * std::log10(255.0 * 255.0 / mean_squared)) : 99.0;

  const cv::Mat ssim = SsimMap(LumaOf(expected), LumaOf(found));
  double ssim_sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (*labels.At(x, y) != 0) ssim_sum += ssim.at<float>(y, x);
    }
  }
  errors.ssim = ssim_sum / static_cast<double>(errors.num_pixels);
  return errors;
}

void AddMaskOverlaps(const Image16& true_labels,
                     const Image16& found_labels,
                     std::vector<MaskOverlap>& overlaps) {
  CheckSameSize(true_labels.width,
                true_labels.height,
                found_labels.width,
                found_labels.height,
                "a face mask");
  const size_t num_faces = overlaps.size();
  for (size_t i = 0; i < true_labels.values.size(); ++i) {
    const size_t expected = true_labels.values[i] <= num_faces ? true_labels.values[i] : 0;
    const size_t found = found_labels.values[i] <= num_faces ? found_labels.values[i] : 0;
    if (expected > 0) ++overlaps[expected - 1].union_px;
    if (found > 0 && found != expected) ++overlaps[found - 1].union_px;
    if (found > 0 && found == expected) ++overlaps[found - 1].intersection_px;
  }
}

}  // namespace groundglass
