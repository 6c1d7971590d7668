// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/lettering.h"

#include "datasets-synthetic/noise.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr float kOpaque = 1;

Rgb ColorOf(uint64_t hash) {
  const auto part = [&](int i) {
    return static_cast<float>(0.02 +
                              0.6 * UniformOf(HashOf(hash, i)) * UniformOf(HashOf(hash, i + 3)));
  };
  return {part(0), part(1), part(2)};
}

cv::Scalar Opaque(const Rgb& color) { return {color[0], color[1], color[2], kOpaque}; }

cv::Mat View(ImageF& image) {
  return cv::Mat(image.height, image.width, CV_32FC4, image.values.data());
}

}  // namespace

ImageF MakeLettering(const std::string& text, const Rgb& color) {
  constexpr int kThickness = 14;
  constexpr double kScale = 3;
  int baseline = 0;
  const cv::Size size =
      cv::getTextSize(text, cv::FONT_HERSHEY_DUPLEX, kScale, kThickness, &baseline);
  cv::Mat mask(size.height + 2 * kThickness, size.width + 2 * kThickness, CV_8U, cv::Scalar(0));
  cv::putText(mask,
              text,
              {kThickness, size.height + kThickness},
              cv::FONT_HERSHEY_DUPLEX,
              kScale,
              255,
              kThickness,
              cv::LINE_AA);
  ImageF image(mask.cols, mask.rows, 4);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      float* pixel = image.At(x, y);
      for (int c = 0; c < 3; ++c) pixel[c] = color[c];
      pixel[3] = static_cast<float>(mask.at<uint8_t>(y, x)) / 255;
    }
  }
  return image;
}

ImageF MakePoster(int number) {
  constexpr int kWidth = 256;
  constexpr int kHeight = 384;
  const uint64_t seed = SeedFor(0, "poster", number);
  ImageF image(kWidth, kHeight, 4);
  cv::Mat view = View(image);
  view.setTo(Opaque(ColorOf(HashOf(seed, 1)) + Rgb(0.25f, 0.25f, 0.22f)));
  for (int i = 0; i < 7; ++i) {
    const auto draw = [&](int part, int range) {
      return static_cast<int>(UniformOf(HashOf(seed, 10 + i, part)) * range);
    };
    const cv::Scalar color = Opaque(ColorOf(HashOf(seed, 20 + i)));
    if (i % 2 == 0) {
      cv::circle(view, {draw(1, kWidth), 60 + draw(2, 220)}, 15 + draw(3, 55), color, cv::FILLED);
    } else {
      cv::rectangle(view,
                    cv::Rect(draw(1, 200), 50 + draw(2, 200), 20 + draw(3, 90), 10 + draw(4, 70)),
                    color,
                    cv::FILLED);
    }
  }
  const cv::Scalar ink = Opaque(Rgb(0.02f, 0.02f, 0.03f));
  cv::putText(view, "PHOTOGRAPHS", {18, 46}, cv::FONT_HERSHEY_DUPLEX, 0.95, ink, 2);
  cv::putText(view, "1888 - 1988", {40, 330}, cv::FONT_HERSHEY_DUPLEX, 0.9, ink, 2);
  cv::putText(view, "open daily 10 to 5", {38, 362}, cv::FONT_HERSHEY_SIMPLEX, 0.6, ink, 1);
  cv::rectangle(view, cv::Rect(0, 0, kWidth, kHeight), Opaque(Rgb(0.6f, 0.6f, 0.58f)), 6);
  return image;
}

ImageF MakeBars() {
  constexpr int kWidth = 48;
  constexpr int kHeight = 400;
  ImageF image(kWidth, kHeight, 4);
  cv::Mat view = View(image);
  const Rgb colors[5] = {{0.45f, 0.05f, 0.04f},
                         {0.55f, 0.35f, 0.03f},
                         {0.04f, 0.12f, 0.35f},
                         {0.03f, 0.2f, 0.1f},
                         {0.3f, 0.1f, 0.25f}};
  int top = 0;
  for (int i = 0; top < kHeight; ++i) {
    const int height = 16 + static_cast<int>(UniformOf(SeedFor(0, "bars", i)) * 50);
    cv::rectangle(view, cv::Rect(0, top, kWidth, height - 8), Opaque(colors[i % 5]), cv::FILLED);
    top += height;
  }
  return image;
}

ImageF MakeQuoins(double low, double high, bool is_left, const Rgb& stone) {
  constexpr double kPixelsPerFoot = 24;
  constexpr double kCourseHeight = 1.333;  // six courses of brick
  constexpr double kJoint = 0.05;
  const int width = static_cast<int>(2 * kPixelsPerFoot);
  const int height = std::max(1, static_cast<int>(std::lround((high - low) * kPixelsPerFoot)));
  ImageF image(width, height, 4);
  for (int y = 0; y < height; ++y) {
    const double v = high - (y + 0.5) * (high - low) / height;
    const double course = std::floor(v / kCourseHeight);
    const double above_joint = v - course * kCourseHeight;
    const double reach = std::fmod(std::abs(course), 2.0) < 0.5 ? 2.0 : 1.2;
    const auto shade = static_cast<float>(
        0.9 + 0.2 * UniformOf(SeedFor(is_left ? 1 : 2, "quoin", static_cast<uint64_t>(course))));
    for (int x = 0; x < width; ++x) {
      const double from_corner = ((is_left ? x : width - 1 - x) + 0.5) / kPixelsPerFoot;
      if (from_corner > reach) continue;
      const bool is_joint = above_joint < kJoint || from_corner > reach - kJoint;
      for (int c = 0; c < 3; ++c) image.At(x, y)[c] = stone[c] * (is_joint ? 0.45f : shade);
      image.At(x, y)[3] = kOpaque;
    }
  }
  return image;
}

ImageF MakeOculus(const Rgb& stone) {
  constexpr int kSize = 160;
  ImageF image(kSize, kSize, 4);
  cv::Mat view = View(image);
  const cv::Point middle(kSize / 2, kSize / 2);
  cv::circle(view, middle, 78, Opaque(stone), cv::FILLED);
  constexpr int kStones = 12;
  for (int i = 0; i < kStones; ++i) {
    const double angle = 2 * CV_PI * i / kStones;
    cv::line(view,
             middle,
             {middle.x + static_cast<int>(78 * std::cos(angle)),
              middle.y + static_cast<int>(78 * std::sin(angle))},
             Opaque(0.45f * stone),
             1);
  }
  cv::circle(view, middle, 58, Opaque(Rgb(0.02f, 0.02f, 0.022f)), cv::FILLED);
  for (int y = -48; y <= 48; y += 12) {
    const int half = static_cast<int>(std::sqrt(56.0 * 56.0 - y * y));
    cv::line(view,
             {middle.x - half, middle.y + y},
             {middle.x + half, middle.y + y},
             Opaque(Rgb(0.2f, 0.21f, 0.2f)),
             5);
  }
  return image;
}

ImageF MakeCoping(double width, double height, const Rgb& stone) {
  constexpr double kPixelsPerFoot = 20;
  constexpr double kDepth = 1.1;  // feet, upright
  const int columns = static_cast<int>(std::lround(width * kPixelsPerFoot));
  const int rows = static_cast<int>(std::lround(height * kPixelsPerFoot));
  ImageF image(columns, rows, 4);
  for (int y = 0; y < rows; ++y) {
    const double above = height - (y + 0.5) / kPixelsPerFoot;
    for (int x = 0; x < columns; ++x) {
      const double from_side = std::min(x + 0.5, columns - x - 0.5) / kPixelsPerFoot;
      const double slope = from_side * height / (width / 2);
      if (above < slope - kDepth) continue;
      const double along = std::fmod(from_side, 3.0);
      const bool is_joint = along < 0.06 || above < slope - kDepth + 0.08;
      for (int c = 0; c < 3; ++c) image.At(x, y)[c] = stone[c] * (is_joint ? 0.45f : 1.0f);
      image.At(x, y)[3] = kOpaque;
    }
  }
  return image;
}

}  // namespace groundglass
