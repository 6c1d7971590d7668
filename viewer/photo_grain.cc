// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/photo_grain.h"

#include "scene/check_option.h"
#include "scene/hash.h"
#include "scene/srgb.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace groundglass {
namespace {

// A square of the photograph: its place, mean code and how much the blur takes away from it.
struct CalmSquare {
  int x = 0;
  int y = 0;
  double mean = 0;
  double sigma = 0;
};

cv::Mat TakenAway(const Image8& srgb8, double blur_px) {
  cv::Mat codes(srgb8.height, srgb8.width, CV_32FC3);
  for (int y = 0; y < srgb8.height; ++y) {
    std::copy_n(srgb8.At(0, y), 3 * srgb8.width, codes.ptr<float>(y));
  }
  cv::Mat smooth;
  cv::GaussianBlur(codes, smooth, {0, 0}, blur_px, blur_px, cv::BORDER_REFLECT);
  return codes - smooth;
}

CalmSquare MeasureSquare(const Image8& srgb8, const cv::Mat& detail, int x0, int y0, int side) {
  CalmSquare square = {x0, y0, 0, 0};
  for (int y = y0; y < y0 + side; ++y) {
    for (int x = x0; x < x0 + side; ++x) {
      const uint8_t* code = srgb8.At(x, y);
      const cv::Vec3f& d = detail.at<cv::Vec3f>(y, x);
      square.mean += Luma(code[0], code[1], code[2]);
      square.sigma += std::pow(Luma(d[0], d[1], d[2]), 2);
    }
  }
  square.mean /= side * side;
  square.sigma = std::sqrt(square.sigma / (side * side));
  return square;
}

ImageF CutSquare(const cv::Mat& detail, const CalmSquare& square, int side) {
  ImageF cut(side, side, 3);
  for (int y = 0; y < side; ++y) {
    const float* from = detail.ptr<float>(square.y + y) + 3 * square.x;
    std::transform(from, from + 3 * side, cut.At(0, y), [&](float value) {
      return static_cast<float>(value / square.sigma);
    });
  }
  return cut;
}

int ToneOf(double mean) {
  return std::clamp(static_cast<int>(mean * PhotoGrain::kTones / 256), 0, PhotoGrain::kTones - 1);
}

// A tone without squares has what the nearest with some has.
void FillTones(const std::array<bool, PhotoGrain::kTones>& is_measured, PhotoGrain& grain) {
  for (int tone = 0; tone < PhotoGrain::kTones; ++tone) {
    if (is_measured[tone]) continue;
    int nearest = -1;
    for (int other = 0; other < PhotoGrain::kTones; ++other) {
      if (!is_measured[other]) continue;
      if (nearest < 0 || std::abs(other - tone) < std::abs(nearest - tone)) nearest = other;
    }
    if (nearest >= 0) grain.sigma[tone] = grain.sigma[nearest];
  }
}

}  // namespace

void PhotoGrainOptions::Check() const {
  CheckFromTo(square_px, 8, 256, "photo grain options: square_px");
  CheckFromTo(blur_px, 0.5, 16, "photo grain options: blur_px");
  CheckFromTo(calm_share, 0.001, 1, "photo grain options: calm_share");
  CheckFromTo(most_between_tones, 1, 100, "photo grain options: most_between_tones");
  CheckFromTo(darkest_code, 0, 255, "photo grain options: darkest_code");
  CheckFromTo(brightest_code, 0, 255, "photo grain options: brightest_code");
  CheckAtLeast(most_squares, 1, "photo grain options: most_squares");
}

double PhotoGrain::SigmaAt(double code) const {
  // A tone's deviation stands at its middle.
  const double at = std::clamp(code * kTones / 256 - 0.5, 0.0, kTones - 1.0);
  const int low = std::min(static_cast<int>(at), kTones - 2);
  return sigma[low] + (at - low) * (sigma[low + 1] - sigma[low]);
}

PhotoGrain MeasurePhotoGrain(const Image8& srgb8, const PhotoGrainOptions& options) {
  options.Check();
  const int side = options.square_px;
  const cv::Mat detail = TakenAway(srgb8, options.blur_px);
  std::array<std::vector<CalmSquare>, PhotoGrain::kTones> squares;
  for (int y = 0; y + side <= srgb8.height; y += side) {
    for (int x = 0; x + side <= srgb8.width; x += side) {
      const CalmSquare square = MeasureSquare(srgb8, detail, x, y, side);
      // Without any grain at all it is no part of the picture: a border, a drawing.
      if (square.mean < options.darkest_code || square.mean > options.brightest_code ||
          square.sigma < 1e-3) {
        continue;
      }
      squares[ToneOf(square.mean)].push_back(square);
    }
  }
  PhotoGrain grain;
  std::array<size_t, PhotoGrain::kTones> num_calm = {};
  double least = std::numeric_limits<double>::infinity();
  for (int tone = 0; tone < PhotoGrain::kTones; ++tone) {
    std::vector<CalmSquare>& found = squares[tone];
    if (found.empty()) continue;
    std::stable_sort(found.begin(), found.end(), [](const CalmSquare& a, const CalmSquare& b) {
      return a.sigma < b.sigma;
    });
    num_calm[tone] = static_cast<size_t>(std::ceil(options.calm_share * found.size()));
    grain.sigma[tone] = found[num_calm[tone] / 2].sigma;
    least = std::min(least, grain.sigma[tone]);
  }
  std::array<bool, PhotoGrain::kTones> is_measured = {};
  for (int tone = 0; tone < PhotoGrain::kTones; ++tone) {
    is_measured[tone] =
        num_calm[tone] > 0 && grain.sigma[tone] <= options.most_between_tones * least;
    if (!is_measured[tone]) continue;
    const size_t num_kept = std::min<size_t>(num_calm[tone], options.most_squares);
    for (size_t i = 0; i < num_kept; ++i) {
      grain.squares.push_back(CutSquare(detail, squares[tone][i], side));
    }
  }
  FillTones(is_measured, grain);
  return grain;
}

ImageF LayGrain(const PhotoGrain& grain, int width, int height, uint64_t seed) {
  ImageF laid(width, height, 3);
  if (grain.squares.empty()) return laid;
  const int side = grain.squares.front().width;
  const int step = side / 2;
  // sin^2 + cos^2 = 1: of two squares that lie over one another the variances add up to one.
  std::vector<float> weight(2 * step);
  for (int i = 0; i < 2 * step; ++i) {
    weight[i] = static_cast<float>(std::sin(std::numbers::pi * (i + 0.5) / (2 * step)));
  }
  for (int y0 = -step; y0 < height; y0 += step) {
    for (int x0 = -step; x0 < width; x0 += step) {
      const uint64_t chance = HashOf(HashOf(HashOf(seed) + x0) + y0);
      const ImageF& square = grain.squares[chance % grain.squares.size()];
      const bool is_turned = (chance >> 40) % 2 == 1;
      const bool is_mirrored = (chance >> 41) % 2 == 1;
      for (int y = std::max(0, -y0); y < 2 * step && y0 + y < height; ++y) {
        for (int x = std::max(0, -x0); x < 2 * step && x0 + x < width; ++x) {
          const float* from =
              square.At(is_mirrored ? side - 1 - x : x, is_turned ? side - 1 - y : y);
          float* to = laid.At(x0 + x, y0 + y);
          for (int c = 0; c < 3; ++c) to[c] += weight[x] * weight[y] * from[c];
        }
      }
    }
  }
  return laid;
}

}  // namespace groundglass
