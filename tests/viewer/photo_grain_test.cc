// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/photo_grain.h"

#include "tests/viewer/montage_samples.h"
#include "tests/viewer/sample_models.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

TEST(PhotoGrain, IsMeasuredWhereThePictureIsCalmAndLaidAsStrong) {
  for (const double sigma : {2.0, 6.0}) {
    const PhotoGrain grain = MeasurePhotoGrain(GrainyPicture(sigma, 3), {});
    // The blur leaves a few percent of white noise, and the calmest squares have a little less.
    EXPECT_NEAR(grain.SigmaAt(120), sigma, 0.15 * sigma);
    const ImageF laid = LayGrain(grain, 301, 203, 5);
    double sum = 0;
    double neighbours = 0;
    for (int y = 0; y < laid.height; ++y) {
      for (int x = 0; x + 1 < laid.width; ++x) {
        sum += laid.At(x, y)[1] * laid.At(x, y)[1];
        neighbours += laid.At(x, y)[1] * laid.At(x + 1, y)[1];
      }
    }
    const double count = laid.height * (laid.width - 1.0);
    EXPECT_NEAR(std::sqrt(sum / count), 1, 0.1);
    EXPECT_LT(std::abs(neighbours / count), 0.15) << "white noise stays white";
    EXPECT_EQ(laid.values, LayGrain(grain, 301, 203, 5).values);
  }
  EXPECT_EQ(MeasurePhotoGrain(MakePlainPage(100, 100, 80, 80, 80), {}).SigmaAt(80), 0);
}

}  // namespace
}  // namespace groundglass
