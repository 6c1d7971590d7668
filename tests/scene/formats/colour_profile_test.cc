// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What a scanner's ICC profile says of its numbers is heeded when an image is read.
#include "scene/formats/image_io.h"
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
  Bytes bytes = Saved(cmsCreateRGBProfile(&kD65, &kSrgbPrimaries, curves));
  cmsFreeToneCurve(curve);
  return bytes;
}

Bytes GreyProfile(double gamma) {
  cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
  Bytes bytes = Saved(cmsCreateGrayProfile(&kD65, curve));
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

// The light that is left after four inks, each of which takes its part: 0 to 1.
std::array<double, 3> PlainPrint(const std::array<double, 4>& inks) {
  std::array<double, 3> light;
  for (int c = 0; c < 3; ++c) light[c] = (1 - inks[c]) * (1 - inks[3]);
  return light;
}

// A press for which that is true, as a table from inks to Lab.
Bytes PressProfile() {
  struct Sampler {
    static cmsInt32Number Sample(const cmsUInt16Number in[], cmsUInt16Number out[], void* to_lab) {
      std::array<double, 4> inks;
      for (int i = 0; i < 4; ++i) inks[i] = in[i] / 65535.0;
      const std::array<double, 3> light = PlainPrint(inks);
      cmsUInt16Number rgb[3];
      for (int c = 0; c < 3; ++c) rgb[c] = static_cast<cmsUInt16Number>(65535 * light[c] + 0.5);
      cmsDoTransform(to_lab, rgb, out, 1);
      return 1;
    }
  };
  cmsHPROFILE srgb = cmsCreate_sRGBProfile();
  cmsHPROFILE lab = cmsCreateLab4Profile(nullptr);
  cmsHTRANSFORM to_lab =
      cmsCreateTransform(srgb, TYPE_RGB_16, lab, TYPE_Lab_16, INTENT_RELATIVE_COLORIMETRIC, 0);
  cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(profile, 4.2);
  cmsSetDeviceClass(profile, cmsSigOutputClass);
  cmsSetColorSpace(profile, cmsSigCmykData);
  cmsSetPCS(profile, cmsSigLabData);
  cmsPipeline* pipeline = cmsPipelineAlloc(nullptr, 4, 3);
  cmsStage* table = cmsStageAllocCLut16bit(nullptr, 11, 4, 3, nullptr);
  EXPECT_TRUE(cmsStageSampleCLut16bit(table, Sampler::Sample, to_lab, 0));
  // A table stands between curves, if only straight ones.
  cmsPipelineInsertStage(pipeline, cmsAT_BEGIN, table);
  cmsPipelineInsertStage(pipeline, cmsAT_BEGIN, cmsStageAllocToneCurves(nullptr, 4, nullptr));
  cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  EXPECT_TRUE(cmsWriteTag(profile, cmsSigAToB0Tag, pipeline));
  cmsPipelineFree(pipeline);
  cmsDeleteTransform(to_lab);
  cmsCloseProfile(srgb);
  cmsCloseProfile(lab);
  return Saved(profile);
}

// Inks as a press' TIFF has them.
template <typename Code>
void WriteInks(const std::filesystem::path& file, const Raster<Code>& inks, const Bytes* profile) {
  const OIIO::TypeDesc type = sizeof(Code) == 1 ? OIIO::TypeUInt8 : OIIO::TypeUInt16;
  OIIO::ImageSpec spec(inks.width, inks.height, 4, type);
  spec.channelnames = {"C", "M", "Y", "K"};
  spec.alpha_channel = -1;
  spec.attribute("tiff:ColorSpace", "CMYK");
  spec.attribute("oiio:ColorSpace", "CMYK");
  if (profile) {
    spec.attribute("ICCProfile",
                   OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile->size())),
                   profile->data());
  }
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output && output->open(file.string(), spec)) << output->geterror();
  ASSERT_TRUE(output->write_image(type, inks.values.data()) && output->close());
}

Image8 SomeInks() {
  Image8 inks(8, 1, 4);
  for (int x = 0; x < 8; ++x) {
    inks.At(x, 0)[0] = static_cast<uint8_t>(30 * x);
    inks.At(x, 0)[1] = static_cast<uint8_t>(200 - 25 * x);
    inks.At(x, 0)[2] = static_cast<uint8_t>(x % 3 * 80);
    inks.At(x, 0)[3] = static_cast<uint8_t>(x % 2 * 60);
  }
  return inks;
}

TEST(Inks, AreConvertedByTheirProfile) {
  const TemporaryFolder folder;
  const Image8 inks = SomeInks();
  Image16 inks16(8, 1, 4);
  for (size_t i = 0; i < inks.values.size(); ++i) {
    inks16.values[i] = static_cast<uint16_t>(257 * inks.values[i]);
  }
  const Bytes profile = PressProfile();
  WriteInks(folder / "8.tif", inks, &profile);
  WriteInks(folder / "16.tif", inks16, &profile);
  EXPECT_TRUE(InspectImage(folder / "8.tif").warnings.empty());
  const Image8 srgb8 = ReadSrgb8(folder / "8.tif");
  const Image8 from16 = ReadSrgb8(folder / "16.tif");
  const ImageF radiance = ReadRadiance(folder / "16.tif");
  ASSERT_EQ(srgb8.channels, 3);
  for (int x = 0; x < 8; ++x) {
    std::array<double, 4> share;
    for (int i = 0; i < 4; ++i) share[i] = inks.At(x, 0)[i] / 255.0;
    const std::array<double, 3> light = PlainPrint(share);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(srgb8.At(x, 0)[c], 255 * light[c], 8) << x << c;
      EXPECT_NEAR(from16.At(x, 0)[c], 255 * light[c], 8) << x << c;
      EXPECT_NEAR(255 * SrgbFromLinear(radiance.At(x, 0)[c]), 255 * light[c], 8) << x << c;
    }
  }
}

TEST(Inks, WithoutAProfileAreThoseOfOrdinaryPrintAndThatIsSaid) {
  const TemporaryFolder folder;
  Image8 inks(3, 1, 4);
  inks.values = {0, 0, 0, 0, 0, 255, 255, 0, 0, 0, 0, 255};  // paper, red, black
  WriteInks(folder / "a.tif", inks, nullptr);
  EXPECT_EQ(ReadSrgb8(folder / "a.tif").values, (Bytes{255, 255, 255, 237, 28, 36, 35, 31, 32}));
  EXPECT_THAT(InspectImage(folder / "a.tif").warnings,
              testing::ElementsAre(HasSubstr("a.tif: is CMYK without an ICC profile")));
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
