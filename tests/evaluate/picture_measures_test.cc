// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/picture_measures.h"

#include "scene/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

Image8 MakeTexture(uint64_t seed) {
  std::mt19937_64 random(seed);
  Image8 image(64, 48, 3);
  for (uint8_t& value : image.values) value = static_cast<uint8_t>(40 + random() % 100);
  return image;
}

Image16 MakeLabels() {
  Image16 labels(64, 48, 1);
  for (int y = 8; y < 40; ++y) {
    for (int x = 8; x < 56; ++x) *labels.At(x, y) = 1;
  }
  return labels;
}

TEST(ComparePictures, ThePictureItselfIsPerfect) {
  const Image8 picture = MakeTexture(1);
  const PictureErrors errors = ComparePictures(picture, picture, MakeLabels(), {});
  EXPECT_GE(errors.psnr_db, 99);
  EXPECT_NEAR(errors.ssim, 1, 1e-6);
  EXPECT_EQ(errors.coverage, 1);
  EXPECT_EQ(errors.num_pixels, 48 * 32);
}

TEST(ComparePictures, AlphaDoesNotCount) {
  const Image8 picture = MakeTexture(1);
  Image8 with_alpha(64, 48, 4);
  for (size_t i = 0; i < with_alpha.values.size(); ++i) {
    const bool is_alpha = i % 4 == 3;
    with_alpha.values[i] = is_alpha ? static_cast<uint8_t>(i) : picture.values[i / 4 * 3 + i % 4];
  }
  const PictureErrors errors = ComparePictures(picture, with_alpha, MakeLabels(), {});
  EXPECT_GE(errors.psnr_db, 99);
  EXPECT_NEAR(errors.ssim, 1, 1e-6);
}

TEST(ComparePictures, AGainOfEachChannelIsFittedAway) {
  const Image8 half = MakeTexture(1);
  Image8 picture = half;
  for (size_t i = 0; i < picture.values.size(); i += 3) picture.values[i] *= 1.8;
  const PictureErrors errors = ComparePictures(picture, half, MakeLabels(), {});
  EXPECT_GT(errors.psnr_db, 55);  // rounding alone
  EXPECT_NEAR(errors.gain[0], 1.8, 0.01);
  EXPECT_NEAR(errors.gain[1], 1, 1e-9);
}

TEST(ComparePictures, KnownNoiseGivesItsPsnr) {
  const Image8 picture = MakeTexture(1);
  Image8 noisy = picture;
  for (size_t i = 0; i < noisy.values.size(); ++i) noisy.values[i] += i % 2 == 0 ? 5 : -5;
  const PictureErrors errors = ComparePictures(picture, noisy, MakeLabels(), {});
  EXPECT_NEAR(errors.psnr_db, 20 * std::log10(255.0 / 5), 0.05);
}

TEST(ComparePictures, UncoveredPixelsCountAsBlackAndOutsideDoesNotCount) {
  Image8 picture(64, 48, 3, 100);
  Image8 rendered = picture;
  Image8 covered(64, 48, 1, 255);
  for (int x = 8; x < 56; ++x) {
    for (int y = 8; y < 16; ++y) *covered.At(x, y) = 0;  // a quarter of the model
  }
  *rendered.At(0, 0) = 255;  // not the model
  const PictureErrors errors = ComparePictures(picture, rendered, MakeLabels(), covered);
  EXPECT_DOUBLE_EQ(errors.coverage, 0.75);
  EXPECT_NEAR(errors.gain[0], 1, 1e-12);
  EXPECT_NEAR(errors.psnr_db, 10 * std::log10(255.0 * 255.0 / (0.25 * 100 * 100)), 1e-9);
}

TEST(ComparePictures, SizesThatDifferAreAnError) {
  EXPECT_THAT([] { ComparePictures(Image8(4, 4, 3), Image8(4, 5, 3), Image16(4, 4, 1), {}); },
              testing::ThrowsMessage<Error>(
                  "the rendered picture is 4x5, expected 4x4 as the true picture"));
}

TEST(MaskOverlap, IntersectionOverUnionOfEachFaceAndOccludersAreNone) {
  Image16 expected(4, 1, 1);
  Image16 found(4, 1, 1);
  expected.values = {1, 1, 2, 251};
  found.values = {1, 2, 2, 2};
  std::vector<MaskOverlap> overlaps(2);
  AddMaskOverlaps(expected, found, overlaps);
  EXPECT_DOUBLE_EQ(overlaps[0].IntersectionOverUnion(), 1.0 / 2);
  EXPECT_DOUBLE_EQ(overlaps[1].IntersectionOverUnion(), 1.0 / 3);
}

}  // namespace
}  // namespace groundglass
