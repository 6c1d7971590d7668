// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/ignore_mask.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::HasSubstr;
using Codes = std::vector<uint8_t>;

template <typename T>
Codes Ignored(const std::string& name, int channels, const std::vector<T>& values) {
  const TemporaryFolder folder;
  const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
  const int width = static_cast<int>(values.size()) / channels;
  OIIO::ImageSpec spec(width, 1, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const auto output = OIIO::ImageOutput::create((folder / name).string());
  EXPECT_TRUE(output && output->open((folder / name).string(), spec));
  EXPECT_TRUE(output->write_image(type, values.data()) && output->close());
  return ReadIgnoreMask(folder / name, {width, 1}).values;
}

TEST(IgnoreMask, WhiteIsHalfOfWhatTheBitsCanSay) {
  EXPECT_EQ(Ignored<uint8_t>("m.png", 1, {0, 127, 128, 255}), (Codes{0, 0, 255, 255}));
  EXPECT_EQ(Ignored<uint16_t>("m.png", 1, {0, 131, 32767, 32768, 65535}),
            (Codes{0, 0, 0, 255, 255}));
  // 0.2 % grey all over, with nothing brighter in it.
  EXPECT_EQ(Ignored<uint16_t>("m.png", 1, {131, 131, 200}), (Codes{0, 0, 0}));
  EXPECT_EQ(Ignored<float>("m.tif", 1, {0, 0.4f, 0.6f, 1}), (Codes{0, 0, 255, 255}));
}

TEST(IgnoreMask, ProgramsThatCountSayOneOr255) {
  EXPECT_EQ(Ignored<uint8_t>("m.png", 1, {0, 1, 0}), (Codes{0, 255, 0}));
  EXPECT_EQ(Ignored<uint16_t>("m.png", 1, {0, 255, 0}), (Codes{0, 255, 0}));
  EXPECT_EQ(Ignored<uint16_t>("m.png", 1, {0, 1, 1}), (Codes{0, 255, 255}));
  EXPECT_EQ(Ignored<float>("m.tif", 1, {0, 255, 100}), (Codes{0, 255, 0}));
}

TEST(IgnoreMask, PaintOfAnyColourAndOnATransparentGround) {
  EXPECT_EQ(Ignored<uint8_t>("m.png", 3, {0, 0, 0, 255, 0, 0, 0, 0, 255, 40, 40, 40}),
            (Codes{0, 255, 255, 0}));
  // White paint, transparent around, whatever colour lies there.
  EXPECT_EQ(Ignored<uint8_t>("m.png", 4, {255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 0}),
            (Codes{255, 0, 0}));
  // Only the alpha varies: it is the mask.
  EXPECT_EQ(Ignored<uint8_t>("m.png", 2, {0, 255, 0, 0}), (Codes{255, 0}));
  // An opaque one says nothing by its alpha.
  EXPECT_EQ(Ignored<uint8_t>("m.png", 2, {0, 255, 255, 255}), (Codes{0, 255}));
}

TEST(IgnoreMask, AnotherSizeIsAnError) {
  const TemporaryFolder folder;
  WriteLabels(folder / "s2.png", Image16(30, 20, 1));
  EXPECT_THAT(ThrownMessage([&] {
                ReadIgnoreMask(folder / "s2.png", {30, 21});
              }),
              HasSubstr("s2.png: mask has 30 x 20 pixels, its photograph 30 x 21"));
}

}  // namespace
}  // namespace groundglass
