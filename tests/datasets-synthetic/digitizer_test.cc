// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/digitizer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

TEST(MountOpening, ReachesItsMarginBeyondTheFrameAndMovesWithTheSlide) {
  const MountOpening opening{9};
  SlideTransform slide;
  EXPECT_NEAR(DepthInOpening(opening, slide, {0, 500}, 1500, 1000), 9, 1e-9);
  EXPECT_NEAR(DepthInOpening(opening, slide, {750, 1000}, 1500, 1000), 9, 1e-9);
  slide.shift_x_px = 20;
  EXPECT_NEAR(DepthInOpening(opening, slide, {0, 500}, 1500, 1000), -11, 1e-9);
  EXPECT_NEAR(DepthInOpening(opening, slide, {1500, 500}, 1500, 1000), 29, 1e-9);
}

TEST(DrawMount, IsBlackWhereTheSlideUncoversIt) {
  ImageF scan(300, 200, 3, 0.8f);
  SlideTransform slide;
  slide.shift_x_px = 12;
  DrawMount({2}, slide, scan);
  EXPECT_LT(*scan.At(4, 100), 0.04);  // 6 px beyond the opening's border at 10
  EXPECT_EQ(*scan.At(20, 100), 0.8f);
}

// Where a step's middle lies: the first crossing of half way, between pixel centres.
double StepPosition(const ImageF& image, int y) {
  for (int x = 0; x + 1 < image.width; ++x) {
    const double a = *image.At(x, y);
    const double b = *image.At(x + 1, y);
    if (a < 0.5 && b >= 0.5) return x + 0.5 + (0.5 - a) / (b - a);
  }
  return -1;
}

TEST(NtscFromScan, StretchesTheWholeScanToTheFrame) {
  ImageF scan(1500, 1000, 3);
  for (int y = 0; y < 1000; ++y) {
    for (int x = 600; x < 1500; ++x) {
      for (int c = 0; c < 3; ++c) scan.At(x, y)[c] = 1;
    }
  }
  const ImageF frame = NtscFromScan(scan, 1);
  ASSERT_EQ(frame.width, 640);
  ASSERT_EQ(frame.height, 480);
  double sum = 0;
  for (int y = 100; y < 380; y += 2) sum += StepPosition(frame, y);
  EXPECT_NEAR(sum / 140, 600 * 640 / 1500.0, 0.1);
}

TEST(NtscFromScan, KeepsLumaSharperThanChroma) {
  // Grey on the left; on the right a red of the same luma.
  ImageF scan(640, 480, 3, 80 / 255.0f);
  for (int y = 0; y < 480; ++y) {
    for (int x = 320; x < 640; ++x) {
      scan.At(x, y)[0] = 180 / 255.0f;
      scan.At(x, y)[1] = 37 / 255.0f;
      scan.At(x, y)[2] = 37 / 255.0f;
    }
  }
  const ImageF frame = NtscFromScan(scan, 1);
  double left = 0;
  double right = 0;
  for (int y = 0; y < 480; ++y) {
    left += frame.At(318, y)[0] - frame.At(318, y)[1];
    right += frame.At(321, y)[0] - frame.At(321, y)[1];
  }
  EXPECT_GT(255 * left / 480, 20);    // colour bleeds to the left,
  EXPECT_LT(255 * right / 480, 123);  // and is missing to the right, of 143
}

}  // namespace
}  // namespace groundglass
