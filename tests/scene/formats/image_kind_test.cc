// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Images are told by their content, whatever the format and the name.
#include "scene/formats/image_kind.h"

#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "tests/scene/formats/colour_ramp.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// One page after the other, as scanners' programs write them.
void WritePages(const std::filesystem::path& file, const std::vector<Image8>& pages) {
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output);
  std::vector<OIIO::ImageSpec> specs;
  for (const Image8& page : pages) {
    specs.emplace_back(page.width, page.height, page.channels, OIIO::TypeUInt8);
    specs.back().attribute("Compression", file.extension() == ".webp" ? "webp:100" : "lzw");
  }
  if (pages.size() == 1) {
    ASSERT_TRUE(output->open(file.string(), specs[0])) << output->geterror();
  } else {
    ASSERT_TRUE(output->open(file.string(), static_cast<int>(pages.size()), specs.data()));
  }
  for (size_t i = 0; i < pages.size(); ++i) {
    if (i > 0) {
      ASSERT_TRUE(output->open(file.string(), specs[i], OIIO::ImageOutput::AppendSubimage));
    }
    ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pages[i].values.data()));
  }
  ASSERT_TRUE(output->close());
}

class EveryFormatTest : public testing::TestWithParam<const char*> {};

TEST_P(EveryFormatTest, IsReadUnderAnyName) {
  const std::string extension = GetParam();
  const TemporaryFolder folder;
  const Image8 ramp = ColourRamp(64, 48);
  if (!OIIO::ImageOutput::create("a" + extension)) {
    OIIO::geterror();
    GTEST_SKIP() << "OpenImageIO here cannot write " << extension;
  }
  WritePages(folder / ("a" + extension), {ramp});
  for (const char* name : {"upper.JPG", "none", "odd.v2"}) {
    std::filesystem::copy_file(folder / ("a" + extension), folder / name);
    EXPECT_TRUE(FindImageKind(folder / name).IsImage()) << name;
    const Image8 read = ReadSrgb8(folder / name);
    ASSERT_EQ(read.width, 64);
    ASSERT_EQ(read.height, 48);
    EXPECT_THAT(InspectImage(folder / name).warnings, IsEmpty());
    const bool is_lossy =
        extension == ".heic" || extension == ".jpg" || extension == ".webp" || extension == ".jp2";
    for (const auto& [x, y] : {std::pair(3, 5), std::pair(60, 40), std::pair(30, 24)}) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(read.At(x, y)[c], ramp.At(x, y)[c], is_lossy ? 6 : 0) << name << x << y << c;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formats,
    EveryFormatTest,
    testing::Values(".jpg", ".png", ".tif", ".ppm", ".bmp", ".webp", ".heic", ".jp2", ".sgi"));

// A TIFF header, and a directory that holds the orientation alone.
TEST(ImageKind, AWebpThatItsExifTurnsIsTurned) {
  const TemporaryFolder folder;
  if (!OIIO::ImageOutput::create("a.webp")) {
    OIIO::geterror();
    GTEST_SKIP() << "OpenImageIO here cannot write .webp";
  }
  WritePages(folder / "a.webp", {ColourRamp(30, 20)});
  std::string bytes = ReadTextFile(folder / "a.webp");
  const std::string exif("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0", 26);
  bytes += "EXIF" + std::string("\x1A\0\0\0", 4) + exif;
  bytes[4] = static_cast<char>((bytes.size() - 8) & 0xFF);
  bytes[5] = static_cast<char>((bytes.size() - 8) >> 8 & 0xFF);
  const Image8 turned = ReadSrgb8(folder.Write("turned.webp", bytes));
  EXPECT_EQ(turned.width, 20);
  EXPECT_EQ(turned.height, 30);
  EXPECT_EQ(ReadImageSize(folder / "turned.webp").width, 20);
  // A block that is none spoils nothing.
  bytes.replace(bytes.size() - exif.size(), exif.size(), exif.size(), '\x7F');
  EXPECT_EQ(ReadSrgb8(folder.Write("odd.webp", bytes)).width, 30);
}

TEST(ImageKind, LabIsNoRgb) {
  const TemporaryFolder folder;
  WritePages(folder / "a.tif", {ColourRamp(30, 20)});
  std::string bytes = ReadTextFile(folder / "a.tif");
  // The photometric interpretation: a short, RGB (2), which becomes CIELAB (8).
  const std::string rgb("\x06\x01\x03\0\x01\0\0\0\x02\0", 10);
  const size_t at = bytes.find(rgb);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 8] = 8;
  EXPECT_THAT(ThrownMessage([&] { ReadSrgb8(folder.Write("lab.tif", bytes)); }),
              HasSubstr("its colours are CIELAB"));
}

TEST(ImageKind, TargaGoesByItsName) {
  const TemporaryFolder folder;
  WritePages(folder / "a.tga", {ColourRamp(30, 20)});
  EXPECT_EQ(ReadSrgb8(folder / "a.tga").values, ColourRamp(30, 20).values);
}

TEST(ImageKind, ATargaUnderAnotherNameIsToldByItsHeader) {
  const TemporaryFolder folder;
  WritePages(folder / "a.tga", {ColourRamp(30, 20)});
  for (const char* name : {"a.jpeg", "a.png", "a"}) {
    std::filesystem::copy_file(folder / "a.tga", folder / name);
    EXPECT_EQ(FindImageKind(folder / name).reader, "targa") << name;
    EXPECT_EQ(ReadSrgb8(folder / name).values, ColourRamp(30, 20).values) << name;
  }
  // A header that no Targa has, and one whose pixels are missing.
  std::string odd = ReadTextFile(folder / "a.tga");
  odd[17] = static_cast<char>(odd[17] | 0x40);
  EXPECT_FALSE(FindImageKind(folder.Write("b.jpeg", odd)).IsImage());
  EXPECT_FALSE(FindImageKind(folder.Write("c.jpeg", ReadTextFile(folder / "a.tga").substr(0, 24)))
                   .IsImage());
}

TEST(ImageKind, CameraRawIsNotTakenForItsThumbnail) {
  // A TIFF's header, one directory of one entry: DNGVersion 1.4.0.0.
  const std::string dng("II*\0\x08\0\0\0\x01\0\x12\xC6\x01\0\x04\0\0\0\x01\x04\0\0\0\0\0\0", 26);
  const TemporaryFolder folder;
  EXPECT_EQ(FindImageKind(folder.Write("a.tif", dng)).reader, "raw");
  // The same without: a TIFF.
  std::string tiff = dng;
  tiff[10] = 0x13;
  EXPECT_EQ(FindImageKind(folder.Write("b.dng", tiff)).reader, "tiff");
}

TEST(ImageKind, SaysWhatAFileIsAndWhatToDo) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& bytes) {
    const auto file = folder.Write(name, bytes);
    return ThrownMessage([&] { ReadSrgb8(file); });
  };
  EXPECT_THAT(message("a.jpg", "%PDF-1.4 "),
              AllOf(HasSubstr("it is a PDF"), HasSubstr("pdftoppm")));
  EXPECT_THAT(message("b.jpg", ""), AllOf(HasSubstr("an empty file"), HasSubstr("copy it again")));
  EXPECT_THAT(message("c.jpg", std::string(500, '\0')), HasSubstr("a file of zeros"));
  EXPECT_THAT(message("d.jpg", "<!DOCTYPE html><html>"), HasSubstr("a web page"));
  EXPECT_THAT(message("e.jpg", "version https://git-lfs.github.com/spec/v1\n"),
              HasSubstr("git lfs pull"));
  EXPECT_THAT(message("f.jpg",
                      std::string("\0\0\0\x18"
                                  "ftypmp42\0\0\0\0mp42isom",
                                  24)),
              AllOf(HasSubstr("a film"), HasSubstr("ffmpeg")));
  EXPECT_THAT(message("g.jxl", "\xFF\x0A\x01\x02"), HasSubstr("a JPEG XL"));
}

TEST(ImageStem, LosesOnlyAnImagesExtension) {
  EXPECT_EQ(ImageStem("images/s5.JPG"), "s5");
  EXPECT_EQ(ImageStem("s5"), "s5");
  EXPECT_EQ(ImageStem("house.v2"), "house.v2");
  EXPECT_EQ(ImageStem("house.v2.tiff"), "house.v2");
  EXPECT_EQ(ImageStem("DSC.0001"), "DSC.0001");
  EXPECT_EQ(ImageStem("DSC1.NEF"), "DSC1");
}

TEST(ListImageFiles, AreThoseByContentOrName) {
  const TemporaryFolder folder;
  WriteSrgb8(folder / "s10.png", ColourRamp(4, 4));
  WriteSrgb8(folder / "s2.png", ColourRamp(4, 4));
  std::filesystem::rename(folder / "s2.png", folder / "s2");
  folder.Write("s3.jpg", "");
  folder.Write("notes.txt", "no image");
  folder.Write(".s4.jpg", "");
  EXPECT_THAT(ListImageFiles(folder.path()),
              ElementsAre(folder / "s2", folder / "s3.jpg", folder / "s10.png"));
}

TEST(Pages, TheLargestIsTakenAndThatIsSaid) {
  const TemporaryFolder folder;
  WritePages(folder / "thumbnail_first.tif", {Image8(15, 10, 3, 7), ColourRamp(60, 40)});
  EXPECT_EQ(ReadSrgb8(folder / "thumbnail_first.tif").values, ColourRamp(60, 40).values);
  EXPECT_EQ(ReadImageSize(folder / "thumbnail_first.tif").width, 60);
  EXPECT_EQ(ReadGrey8(folder / "thumbnail_first.tif").width, 60);
  EXPECT_THAT(InspectImage(folder / "thumbnail_first.tif").warnings,
              ElementsAre(HasSubstr("thumbnail_first.tif: has 2 pages; page 2 of 60 x 40 pixels, "
                                    "the largest, is taken")));
  WritePages(folder / "thumbnail_last.tif", {ColourRamp(60, 40), Image8(15, 10, 3, 7)});
  EXPECT_EQ(ReadSrgb8(folder / "thumbnail_last.tif").width, 60);
  EXPECT_THAT(InspectImage(folder / "thumbnail_last.tif").warnings, IsEmpty());
  WritePages(folder / "book.tif", {ColourRamp(60, 40), Image8(60, 40, 3, 7)});
  EXPECT_EQ(ReadSrgb8(folder / "book.tif").values, ColourRamp(60, 40).values);
  EXPECT_THAT(InspectImage(folder / "book.tif").warnings,
              ElementsAre(HasSubstr("page 1 of 60 x 40 pixels, the first of the largest")));
}

TEST(JpegEnd, WithoutItsMarkIsAWarningAndCutIsAnError) {
  const TemporaryFolder folder;
  WriteSrgb8(folder / "whole.jpg", ColourRamp(80, 60));
  const std::string whole = ReadTextFile(folder / "whole.jpg");
  const auto no_mark = folder.Write("no_mark.jpg", whole.substr(0, whole.size() - 2));
  EXPECT_EQ(ReadSrgb8(no_mark).values, ReadSrgb8(folder / "whole.jpg").values);
  EXPECT_EQ(ReadGrey8(no_mark).values, ReadGrey8(folder / "whole.jpg").values);
  EXPECT_THAT(InspectImage(no_mark).warnings, ElementsAre(HasSubstr("lacks its end mark")));
  for (const size_t missing : {6, 40, 400}) {
    const std::string cut = whole.substr(0, whole.size() - missing);
    EXPECT_THAT(ThrownMessage([&] { InspectImage(folder.Write("cut.jpg", cut)); }),
                HasSubstr("cut.jpg: this image is damaged: the file ends before the picture does"))
        << missing;
    // Filled up with zeros, as interrupted copies are.
    const auto filled = folder.Write("filled.jpg", cut + std::string(missing + 5000, '\0'));
    EXPECT_THAT(ThrownMessage([&] { ReadSrgb8(filled); }), HasSubstr("is damaged")) << missing;
  }
  // Bytes between the picture and the mark are a trifle.
  const auto extra = folder.Write(
      "extra.jpg", whole.substr(0, whole.size() - 2) + std::string(3, 'x') + "\xFF\xD9");
  EXPECT_EQ(ReadSrgb8(extra).values, ReadSrgb8(folder / "whole.jpg").values);
}

}  // namespace
}  // namespace groundglass
