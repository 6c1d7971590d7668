// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What a scanner's ICC profile says of its numbers is heeded when an image is read.
#include "scene/image_io.h"
#include "scene/srgb.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcms2.h>

#include <cmath>

namespace groundglass {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<uint8_t>;

Bytes Saved(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  EXPECT_TRUE(cmsSaveProfileToMem(profile, nullptr, &size));
  Bytes bytes(size);
  EXPECT_TRUE(cmsSaveProfileToMem(profile, bytes.data(), &size));
  cmsCloseProfile(profile);
  return bytes;
}

constexpr cmsCIExyY kD65 = {0.3127, 0.3290, 1};
constexpr cmsCIExyYTRIPLE kSrgbPrimaries = {{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};

// sRGB's colours, but a plain power in place of its curve.
Bytes GammaProfile(double gamma) {
  cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
  cmsToneCurve* curves[] = {curve, curve, curve};
  const Bytes bytes = Saved(cmsCreateRGBProfile(&kD65, &kSrgbPrimaries, curves));
  cmsFreeToneCurve(curve);
  return bytes;
}

Bytes GreyProfile(double gamma) {
  cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
  const Bytes bytes = Saved(cmsCreateGrayProfile(&kD65, curve));
  cmsFreeToneCurve(curve);
  return bytes;
}

template <typename Code>
void WriteWithProfile(const std::filesystem::path& file,
                      const Raster<Code>& codes,
                      const Bytes& profile) {
  const OIIO::TypeDesc type = sizeof(Code) == 1 ? OIIO::TypeUInt8 : OIIO::TypeUInt16;
  OIIO::ImageSpec spec(codes.width, codes.height, codes.channels, type);
  spec.attribute("ICCProfile",
                 OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                 profile.data());
  spec.attribute("Compression", "jpeg:100");
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output && output->open(file.string(), spec));
  ASSERT_TRUE(output->write_image(type, codes.values.data()) && output->close());
}

TEST(ColourProfile, AppliesInJpegTiffAndPng) {
  const TemporaryFolder folder;
  Image8 codes(16, 16, 3);
  for (size_t i = 0; i < codes.values.size(); i += 3) {
    codes.values[i] = 200;
    codes.values[i + 1] = 120;
    codes.values[i + 2] = 60;
  }
  for (const char* name : {"a.jpg", "a.tif", "a.png"}) {
    WriteWithProfile(folder / name, codes, GammaProfile(1.8));
    const Image8 srgb8 = ReadSrgb8(folder / name);
    const ImageF radiance = ReadRadiance(folder / name);
    for (int c = 0; c < 3; ++c) {
      const double linear = std::pow(codes.values[c] / 255.0, 1.8);
      EXPECT_NEAR(srgb8.At(5, 5)[c], 255 * SrgbFromLinear(static_cast<float>(linear)), 1.6) << name;
      EXPECT_NEAR(radiance.At(5, 5)[c], linear, 0.012) << name;
    }
  }
}

TEST(ColourProfile, SixteenBitsKeepTheirPrecision) {
  const TemporaryFolder folder;
  Image16 codes(256, 1, 3);
  for (int x = 0; x < 256; ++x) {
    for (int c = 0; c < 3; ++c) codes.At(x, 0)[c] = static_cast<uint16_t>(20000 + x);
  }
  WriteWithProfile(folder / "a.tif", codes, GammaProfile(1.8));
  const ImageF radiance = ReadRadiance(folder / "a.tif");
  for (int x = 0; x < 256; ++x) {
    EXPECT_NEAR(radiance.At(x, 0)[1], std::pow((20000 + x) / 65535.0, 1.8), 1e-4);
  }
  EXPECT_GT(radiance.At(255, 0)[1], radiance.At(235, 0)[1]);
}

TEST(ColourProfile, WiderPrimariesAreBroughtToSrgb) {
  // A scanner whose green is purer than sRGB's: its half-saturated green is sRGB's fuller one.
  const TemporaryFolder folder;
  constexpr cmsCIExyYTRIPLE kWide = {{0.64, 0.33, 1}, {0.21, 0.71, 1}, {0.15, 0.06, 1}};
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 2.2);
  cmsToneCurve* curves[] = {curve, curve, curve};
  const Bytes profile = Saved(cmsCreateRGBProfile(&kD65, &kWide, curves));  // as Adobe RGB (1998)
  cmsFreeToneCurve(curve);
  Image8 codes(8, 8, 3);
  for (size_t i = 0; i < codes.values.size(); i += 3) {
    codes.values[i] = 150;
    codes.values[i + 1] = 180;
    codes.values[i + 2] = 150;
  }
  WriteWithProfile(folder / "a.png", codes, profile);
  const Image8 srgb8 = ReadSrgb8(folder / "a.png");
  // Linear Adobe RGB to linear sRGB: red = 1.3984 r - 0.3984 g, green = g, blue = 1.0429 b -
  // 0.0429 g (both with D65).
  const double r = std::pow(150 / 255.0, 2.2);
  const double g = std::pow(180 / 255.0, 2.2);
  EXPECT_NEAR(
      srgb8.values[0], 255 * SrgbFromLinear(static_cast<float>(1.3984 * r - 0.3984 * g)), 2);
  EXPECT_NEAR(srgb8.values[1], 255 * SrgbFromLinear(static_cast<float>(g)), 2);
  EXPECT_NEAR(
      srgb8.values[2], 255 * SrgbFromLinear(static_cast<float>(1.0429 * r - 0.0429 * g)), 2);
}

TEST(ColourProfile, SrgbLeavesEveryCodeAsItIs) {
  const TemporaryFolder folder;
  Image8 codes(256, 1, 3);
  for (int x = 0; x < 256; ++x) {
    codes.At(x, 0)[0] = static_cast<uint8_t>(x);
    codes.At(x, 0)[1] = static_cast<uint8_t>(255 - x);
    codes.At(x, 0)[2] = static_cast<uint8_t>(x / 2);
  }
  WriteWithProfile(folder / "a.png", codes, Saved(cmsCreate_sRGBProfile()));
  EXPECT_EQ(ReadSrgb8(folder / "a.png").values, codes.values);
}

TEST(ColourProfile, GreyScansHaveGreyProfiles) {
  const TemporaryFolder folder;
  const Image8 codes(8, 8, 1, 120);
  WriteWithProfile(folder / "a.tif", codes, GreyProfile(1.8));
  const Image8 srgb8 = ReadSrgb8(folder / "a.tif");
  const double linear = std::pow(120 / 255.0, 1.8);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(srgb8.At(7, 7)[c], 255 * SrgbFromLinear(static_cast<float>(linear)), 1.6);
  }
}

TEST(ColourProfile, WrongProfilesAreErrorsThatSaySo) {
  const TemporaryFolder folder;
  const Image8 colour(8, 8, 3, 120);
  Bytes damaged = GammaProfile(1.8);
  std::fill(damaged.begin() + 128, damaged.end(), uint8_t{0xEE});  // all but its header
  WriteWithProfile(folder / "damaged.tif", colour, damaged);
  EXPECT_THAT(ThrownMessage([&] { ReadSrgb8(folder / "damaged.tif"); }),
              HasSubstr("damaged.tif: its ICC profile"));
  WriteWithProfile(folder / "grey.tif", colour, GreyProfile(2.2));
  EXPECT_THAT(ThrownMessage([&] { ReadSrgb8(folder / "grey.tif"); }),
              HasSubstr("grey.tif: its ICC profile is for grey, its pixels are RGB; convert the "
                        "image to sRGB, or remove its profile"));
  EXPECT_THAT(ThrownMessage([&] { ReadRadiance(folder / "grey.tif"); }),
              HasSubstr("for grey, its pixels are RGB"));
}

}  // namespace
}  // namespace groundglass
