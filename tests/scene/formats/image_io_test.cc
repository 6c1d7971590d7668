// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"

#include "scene/formats/ignore_mask.h"
#include "scene/formats/view_io.h"
#include "scene/srgb.h"
#include "tests/scene/formats/colour_ramp.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

using testing::HasSubstr;

// Writes raw values with any channels, type and orientation, as other programs would.
template <typename T>
void WriteRaw(const std::filesystem::path& file,
              const Raster<T>& raster,
              OIIO::TypeDesc type,
              int orientation = 1) {
  OIIO::ImageSpec spec(raster.width, raster.height, raster.channels, type);
  spec.attribute("Orientation", orientation);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output && output->open(file.string(), spec));
  ASSERT_TRUE(output->write_image(type, raster.values.data()) && output->close());
}

// A smooth ramp that JPEG keeps well: red grows to the right, green downwards.

TEST(Srgb, KnownValues) {
  EXPECT_FLOAT_EQ(LinearFromSrgb(0), 0);
  EXPECT_FLOAT_EQ(LinearFromSrgb(1), 1);
  EXPECT_NEAR(LinearFromSrgb(0.5f), 0.2140411, 1e-6);
  EXPECT_NEAR(LinearFromSrgb(0.04045f), 0.04045 / 12.92, 1e-7);
  EXPECT_NEAR(SrgbFromLinear(0.18f), 0.4613561, 1e-6);
  EXPECT_FLOAT_EQ(SrgbFromLinear(-1), 0);
  EXPECT_FLOAT_EQ(SrgbFromLinear(2), 1);
  EXPECT_FLOAT_EQ(SrgbFromLinear(std::nanf("")), 0);
}

TEST(Srgb, EveryCodeOf8And16BitsSurvives) {
  for (int code = 0; code < 65536; ++code) {
    const float back = SrgbFromLinear(LinearFromSrgb(static_cast<float>(code) / 65535)) * 65535;
    ASSERT_EQ(std::lround(back), code);
  }
  for (int code = 0; code < 256; ++code) {
    const float back = SrgbFromLinear(LinearFromSrgb(static_cast<float>(code) / 255)) * 255;
    ASSERT_EQ(std::lround(back), code);
  }
}

TEST(Srgb, TableKeepsToTheFormula) {
  for (int i = 0; i <= 100000; ++i) {
    const double linear = i / 100000.0;
    const double exact =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    ASSERT_NEAR(SrgbFromLinear(static_cast<float>(linear)), exact, 5e-7) << linear;
  }
}

class LosslessTest : public testing::TestWithParam<const char*> {};

TEST_P(LosslessTest, KeepsEveryByte) {
  const TemporaryFolder folder;
  const auto file = folder / (std::string("ramp") + GetParam());
  const Image8 ramp = ColourRamp(60, 40);
  WriteSrgb8(file, ramp);
  EXPECT_EQ(ReadSrgb8(file).values, ramp.values);
  EXPECT_EQ(ReadImageSize(file).width, 60);
  EXPECT_EQ(ReadImageSize(file).height, 40);
  // Radiance and back is the same bytes too.
  WriteRadiance(folder / (std::string("again") + GetParam()), ReadRadiance(file));
  EXPECT_EQ(ReadSrgb8(folder / (std::string("again") + GetParam())).values, ramp.values);
}

INSTANTIATE_TEST_SUITE_P(Formats, LosslessTest, testing::Values(".png", ".tif", ".exr"));

TEST(WriteSrgb8, JpegIsCloseAndNotSubsampled) {
  const TemporaryFolder folder;
  // One-pixel stripes of colour would wash out in 4:2:0.
  Image8 stripes(64, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      stripes.At(x, y)[0] = x % 2 == 0 ? 180 : 80;
      stripes.At(x, y)[1] = 120;
      stripes.At(x, y)[2] = x % 2 == 0 ? 80 : 180;
    }
  }
  WriteSrgb8(folder / "s.jpg", stripes);
  const Image8 back = ReadSrgb8(folder / "s.jpg");
  double sum = 0;
  for (size_t i = 0; i < back.values.size(); ++i) {
    sum += std::abs(int{back.values[i]} - int{stripes.values[i]});
  }
  EXPECT_LT(sum / static_cast<double>(back.values.size()), 3);
  const Image8 decoded = DecodeSrgb8(EncodeImage(stripes, ".jpg"), ".jpg");
  EXPECT_EQ(decoded.values, back.values);
}

TEST(EncodeImage, PngIsExactInMemory) {
  const Image8 ramp = ColourRamp(17, 9);
  EXPECT_EQ(DecodeSrgb8(EncodeImage(ramp, ".png"), ".png").values, ramp.values);
}

TEST(ReadImages, SixteenBitsKeepTheirPrecision) {
  for (const char* name : {"deep.png", "deep.tif"}) {
    const TemporaryFolder folder;
    ImageF radiance(256, 1, 3);
    for (int x = 0; x < 256; ++x) {
      for (int c = 0; c < 3; ++c) {
        radiance.At(x, 0)[c] = 0.1f + 0.001f * static_cast<float>(x);
      }
    }
    ImageWriteOptions options;
    options.bits = 16;
    WriteRadiance(folder / name, radiance, options);
    const ImageF back = ReadRadiance(folder / name);
    for (size_t i = 0; i < back.values.size(); ++i) {
      ASSERT_NEAR(back.values[i], radiance.values[i], 3e-5) << name;
    }
  }
}

TEST(ReadImages, FloatsAreLinearLight) {
  const TemporaryFolder folder;
  ImageF half(2, 1, 3, 0.5f);
  half.values[0] = 7.5f;  // brighter than white
  WriteRadiance(folder / "h.exr", half);
  EXPECT_FLOAT_EQ(ReadRadiance(folder / "h.exr").values[1], 0.5f);
  EXPECT_FLOAT_EQ(ReadRadiance(folder / "h.exr").values[0], 7.5f);
  EXPECT_EQ(ReadSrgb8(folder / "h.exr").values[1], 188);
  EXPECT_EQ(ReadSrgb8(folder / "h.exr").values[0], 255);
  WriteRaw(folder / "f.tif", half, OIIO::TypeFloat);
  EXPECT_FLOAT_EQ(ReadRadiance(folder / "f.tif").values[1], 0.5f);
}

TEST(ReadImages, GreyIsRepeatedAndAlphaDropped) {
  const TemporaryFolder folder;
  WriteRaw(folder / "grey.png", Image8(3, 2, 1, 77), OIIO::TypeUInt8);
  EXPECT_EQ(ReadSrgb8(folder / "grey.png").values, std::vector<uint8_t>(18, 77));
  WriteRaw(folder / "grey_alpha.png", Image8(3, 2, 2, 90), OIIO::TypeUInt8);
  EXPECT_EQ(ReadSrgb8(folder / "grey_alpha.png").values, std::vector<uint8_t>(18, 90));
  Image8 rgba(1, 1, 4);
  rgba.values = {200, 100, 50, 10};
  WriteRaw(folder / "rgba.png", rgba, OIIO::TypeUInt8);
  EXPECT_EQ(ReadSrgb8(folder / "rgba.png").values, (std::vector<uint8_t>{200, 100, 50}));
}

TEST(ReadGrey8, WeighsAsLumaDoes) {
  const TemporaryFolder folder;
  Image8 colours(3, 1, 3);
  colours.values = {255, 0, 0, 0, 255, 0, 0, 0, 255};
  WriteSrgb8(folder / "c.png", colours);
  EXPECT_EQ(ReadGrey8(folder / "c.png").values, (std::vector<uint8_t>{54, 182, 18}));
}

TEST(ReadGrey8, ATallPictureIsReadByRowsAsItIsWhole) {
  const TemporaryFolder folder;
  Image8 colours(3, 150, 3);
  for (size_t i = 0; i < colours.values.size(); ++i) {
    colours.values[i] = static_cast<uint8_t>(37 * i % 256);
  }
  WriteSrgb8(folder / "c.png", colours);
  const Image8 grey = ReadGrey8(folder / "c.png");
  ASSERT_EQ(grey.height, 150);
  for (size_t i = 0; i < grey.values.size(); ++i) {
    const double luma = 0.2126 * colours.values[3 * i] + 0.7152 * colours.values[3 * i + 1] +
                        0.0722 * colours.values[3 * i + 2];
    EXPECT_NEAR(grey.values[i], luma, 0.51) << i;
  }
}

TEST(ReadImages, EveryOrientationComesUpright) {
  // Stored so that a viewer that heeds the code shows 1 2 3 over 4 5 6.
  const std::vector<std::vector<uint8_t>> stored = {{1, 2, 3, 4, 5, 6},
                                                    {3, 2, 1, 6, 5, 4},
                                                    {6, 5, 4, 3, 2, 1},
                                                    {4, 5, 6, 1, 2, 3},
                                                    {1, 4, 2, 5, 3, 6},
                                                    {3, 6, 2, 5, 1, 4},
                                                    {6, 3, 5, 2, 4, 1},
                                                    {4, 1, 5, 2, 6, 3}};
  const TemporaryFolder folder;
  for (int code = 1; code <= 8; ++code) {
    Image8 raster(code < 5 ? 3 : 2, code < 5 ? 2 : 3, 1);
    raster.values = stored[static_cast<size_t>(code - 1)];
    WriteRaw(folder / "o.tif", raster, OIIO::TypeUInt8, code);
    const Image16 labels = ReadLabels(folder / "o.tif");
    EXPECT_EQ(labels.width, 3) << code;
    EXPECT_EQ(labels.values, (std::vector<uint16_t>{1, 2, 3, 4, 5, 6})) << code;
    EXPECT_EQ(ReadImageSize(folder / "o.tif").width, 3) << code;
  }
}

TEST(ReadLabels, KeepsCodesOf8And16Bits) {
  const TemporaryFolder folder;
  Image8 small(2, 1, 1);
  small.values = {7, 255};
  WriteRaw(folder / "8.png", small, OIIO::TypeUInt8);
  EXPECT_EQ(ReadLabels(folder / "8.png").values, (std::vector<uint16_t>{7, 255}));
  Image16 large(2, 1, 1);
  large.values = {300, 65535};
  WriteLabels(folder / "16.png", large);
  EXPECT_EQ(ReadLabels(folder / "16.png").values, large.values);
}

TEST(ReadImages, BadFilesGiveOneLine) {
  const TemporaryFolder folder;
  EXPECT_EQ(ThrownMessage([&] { ReadSrgb8(folder / "none.jpg"); }),
            (folder / "none.jpg").string() + ": no such image file");
  folder.Write("text.jpg", "this is not a picture");
  EXPECT_THAT(ThrownMessage([&] { ReadImageSize(folder / "text.jpg"); }),
              HasSubstr("text.jpg: cannot read this as an image"));
  folder.Write("empty.png", "");
  EXPECT_THAT(ThrownMessage([&] { ReadSrgb8(folder / "empty.png"); }),
              HasSubstr("empty.png: cannot read this as an image"));
}

class CutShortTest : public testing::TestWithParam<const char*> {};

TEST_P(CutShortTest, IsAnErrorWhereverItIsCut) {
  const TemporaryFolder folder;
  Image8 noise = ColourRamp(80, 60);
  for (size_t i = 0; i < noise.values.size(); ++i) {
    noise.values[i] = static_cast<uint8_t>(noise.values[i] + (i * 2654435761u >> 13) % 30);
  }
  const auto whole = folder / (std::string("whole") + GetParam());
  WriteSrgb8(whole, noise);
  const std::string bytes = ReadTextFile(whole);
  for (const double share : {0.02, 0.3, 0.6, 0.95}) {
    const auto file = folder.Write(std::string("cut") + GetParam(),
                                   bytes.substr(0, static_cast<size_t>(share * bytes.size())));
    EXPECT_THAT(ThrownMessage([&] { ReadSrgb8(file); }), HasSubstr("image")) << share;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, CutShortTest, testing::Values(".jpg", ".png", ".tif", ".exr"));

// An interrupted copy; raw pixels may be black, and masks often are.
TEST(ReadImages, AFileThatEndsInZerosIsTold) {
  const TemporaryFolder work;
  const std::filesystem::path file = work.Write(
      "half.ppm", "P6 40 40 255\n" + std::string(2400, '\x80') + std::string(2400, '\0'));
  EXPECT_THAT(InspectImage(file).warnings,
              testing::ElementsAre(testing::HasSubstr("ends in zeros, the last 50 %")));
  EXPECT_FALSE(ReadIgnoreMask(file, {40, 40}).values.empty());
}

TEST(WriteImages, RefuseWhatCannotBe) {
  const TemporaryFolder folder;
  EXPECT_THAT(ThrownMessage([&] { WriteSrgb8(folder / "a.gif", ColourRamp(4, 4)); }),
              HasSubstr("expected .jpg, .png, .tif or .exr"));
  EXPECT_THAT(ThrownMessage([&] { WriteSrgb8(folder / "a.png", Image8()); }),
              HasSubstr("without pixels"));
  EXPECT_THAT(ThrownMessage([&] { WriteLabels(folder / "a.jpg", Image16(2, 2, 1)); }),
              HasSubstr("a JPEG has 8 bits"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteImages, SamePixelsGiveTheSameBytes) {
  const TemporaryFolder folder;
  for (const char* extension : {".jpg", ".png", ".tif", ".exr"}) {
    const std::string name = extension;
    WriteSrgb8(folder / ("a" + name), ColourRamp(50, 30));
    WriteSrgb8(folder / ("b" + name), ColourRamp(50, 30));
    EXPECT_EQ(ReadTextFile(folder / ("a" + name)), ReadTextFile(folder / ("b" + name))) << name;
  }
}

}  // namespace
}  // namespace groundglass
