// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/pdf_writer.h"
#include "drawing/write_drawing.h"
#include "scene/child_process.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/sample_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace groundglass {
namespace {

using ::testing::HasSubstr;

bool IsInstalled(const std::string& program) {
  try {
    RunProgram({program, "-v"});
    return true;
  } catch (const Error&) {
    return false;
  }
}

// A grey wall of 12 m x 8 m with a red window 1.2 m x 2 m, one texel 2 cm; the window is a face of
// its own in the texture only.
TexturedModel WallWithWindow() {
  Image8 page = MakePlainPage(600, 400, 190, 190, 190);
  for (int y = 150; y < 250; ++y) {
    for (int x = 200; x < 260; ++x) {
      page.At(x, y)[0] = 220;
      page.At(x, y)[1] = page.At(x, y)[2] = 10;
    }
  }
  TexturedModel wall = MakeWall(12, 8, page);
  wall.model.unit = LengthUnit::kMetre;
  return wall;
}

WrittenDrawing WritePdf(const std::filesystem::path& stem, const WriteDrawingOptions& options) {
  const TexturedModel wall = WallWithWindow();
  Renderer renderer(wall);
  return WriteDrawing(stem, renderer, wall, MakeElevation(wall.model, {0}, "wall"), {}, options);
}

struct RedBox {
  int width_px = 0;
  int height_px = 0;
};
RedBox FindRed(const Image8& picture) {
  int left = picture.width, right = -1, top = picture.height, bottom = -1;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const uint8_t* pixel = picture.At(x, y);
      // More than half window, in linear light: texels fade into one another.
      if (pixel[0] < 150 || pixel[1] > 139) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  return {right - left + 1, bottom - top + 1};
}

TEST(PdfScale, AWindowsWidthMeasuredOnTheSheetIsThatOfTheModel) {
  if (!IsInstalled("pdftoppm")) GTEST_SKIP() << "pdftoppm is not installed";
  const TemporaryFolder folder;
  WriteDrawingOptions options;
  options.kinds = {"pdf"};
  WritePdf(folder / "wall", options);
  const std::string out = (folder / "page").string();
  const ProgramResult result =
      RunProgram({"pdftoppm", "-r", "254", "-png", "-singlefile", folder / "wall.pdf", out});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  // At 1:50, ten pixels a millimetre: 1.2 m are 24 mm are 240 px.
  const RedBox window = FindRed(ReadSrgb8(out + ".png"));
  EXPECT_NEAR(window.width_px, 240, 1);
  EXPECT_NEAR(window.height_px, 400, 1);
}

TEST(PdfScale, TheSheetIsAsLargeAsItsDrawingAndMargins) {
  const TemporaryFolder folder;
  WriteDrawingOptions options;
  options.kinds = {"pdf"};
  options.has_title_block = false;
  WritePdf(folder / "wall", options);
  const std::string pdf = ReadTextFile(folder / "wall.pdf");
  // 12 m and 8 m at 1:50 are 240 mm and 160 mm, with 10 mm on each side.
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 737.0079 510.2362]"));
  EXPECT_THAT(pdf, HasSubstr("/R (1:50)"));
  if (IsInstalled("qpdf")) {
    const ProgramResult result = RunProgram({"qpdf", "--check", folder / "wall.pdf"});
    EXPECT_EQ(result.exit_code, 0) << result.output << result.errors;
  }
}

TEST(PdfScale, ALargerSheetThanReadersTakeCountsInLargerUnits) {
  const TemporaryFolder folder;
  WriteDrawingOptions options;
  options.kinds = {"pdf"};
  options.has_title_block = false;
  options.scale = 2;
  options.dpi = 10;
  WritePdf(folder / "wall", options);
  // 6,020 mm are 17,064.6 pt.
  const std::string pdf = ReadTextFile(folder / "wall.pdf");
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 14400 "));
  EXPECT_THAT(pdf, HasSubstr("/UserUnit 1.185"));
}

TEST(PdfPage, SmallNumbersHaveNoExponents) {
  std::string bytes;
  const ByteSink append = [&](std::string_view more) { bytes += more; };
  PdfPage page(append, 100, 100);
  page.SetPen(0.0004, 0.00012);
  page.DrawLine({0.0005, -0.00001}, {1e-7, 123456.5});
  page.Finish("small");
  EXPECT_THAT(bytes, HasSubstr("0.0004 w 0.0001 G"));
  EXPECT_THAT(bytes, HasSubstr("0.0005 0 m 0 123456.5 l S"));
  EXPECT_EQ(bytes.find("e-"), std::string::npos);
}

TEST(PdfPage, DashesAndQuotesAreShownAndWhatCannotBeIsNamed) {
  std::string bytes;
  const ByteSink append = [&](std::string_view more) { bytes += more; };
  PdfPage page(append, 100, 100);
  page.AddLayer("S\u00fcd \u2013 1", true);
  // Dashes, quotes, the euro sign, and an umlaut as macOS parts it, all in Windows-1252.
  page.DrawText({1, 1}, 3, "\u2013 \u2014 \u201eSu\u0308d\u201c \u2019 \u20ac");
  EXPECT_TRUE(page.UnshownCharacters().empty());
  page.DrawText({1, 5}, 3, "\u0141\u00f3d\u017a");
  page.Finish("Dom \u2014 \u0141");
  EXPECT_THAT(bytes, HasSubstr("(\x96 \x97 \x84S\xfc\x64\x93 \x92 \x80) Tj"));
  EXPECT_THAT(bytes, HasSubstr("(?\xf3\x64?) Tj"));
  EXPECT_EQ(page.UnshownCharacters(), (std::set<std::string>{"\u0141", "\u017a"}));
  // Readers show names of layers and the title in fonts of their own.
  EXPECT_THAT(bytes, HasSubstr("/Name <FEFF005300FC006400202013"));
  EXPECT_THAT(bytes, HasSubstr("/Title <FEFF0044006F006D0020201400200141>"));
}

TEST(PdfScale, WhatTheFontCannotShowIsAWarning) {
  const TemporaryFolder folder;
  WriteDrawingOptions options;
  options.kinds = {"pdf"};
  options.note = "\u0141\u00f3d\u017a \u2013 1988";
  const WrittenDrawing written = WritePdf(folder / "wall", options);
  ASSERT_EQ(written.warnings.size(), 1u);
  EXPECT_THAT(written.warnings[0], HasSubstr("font cannot show \u0141 \u017a, and has ?"));
}

}  // namespace
}  // namespace groundglass
