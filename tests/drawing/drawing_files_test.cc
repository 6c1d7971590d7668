// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_layers.h"
#include "drawing/tiff_writer.h"
#include "drawing/write_drawing.h"
#include "scene/child_process.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/sample_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace groundglass {
namespace {

using ::testing::HasSubstr;

// What a program says, where it is installed.
std::optional<std::string> Ask(const std::vector<std::string>& command) {
  try {
    const ProgramResult result = RunProgram(command);
    return result.exit_code == 0 ? result.output : "failed: " + result.errors;
  } catch (const Error&) {
    return std::nullopt;
  }
}

// 6 m x 4 m facing south, 1 m above the model's ground, and a post 1 m before it; the left half of
// the wall is from photograph 1, the right from 2.
struct SampleWall {
  TexturedModel textured = MakeWall(6, 4, MakePlainPage(60, 40, 180, 170, 160));
  DrawingSources sources;
  Drawing drawing;

  SampleWall() {
    PolygonModel& model = textured.model;
    model.unit = LengthUnit::kMetre;
    model.sigma = 0.003;
    for (Eigen::Vector3d& point : model.points_in_world) point.z() += 1;
    model.points_in_world.insert(model.points_in_world.end(),
                                 {{2, -1, 1.5}, {2.5, -1, 1.5}, {2.5, -1, 3}, {2, -1, 3}});
    model.faces.push_back({{4, 5, 6, 7}, "post"});
    textured.faces.emplace_back();
    sources.photographs = {"s1", "s2"};
    sources.provenance = {Image16(60, 40, 1)};
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) *sources.provenance[0].At(x, y) = x < 30 ? 1 : 2;
    }
    sources.faces = {{{0, 1200, 0.010, 0.004, 0.2}, {1, 1200, 0.020, std::nullopt, {}}}, {}};
    DrawingOptions options;
    options.margin = 0.25;
    drawing = MakeElevation(model, {0}, "south wall", options);
  }

  WrittenDrawing Write(const std::filesystem::path& stem, std::vector<std::string> kinds) const {
    Renderer renderer(textured);
    WriteDrawingOptions options;
    options.kinds = std::move(kinds);
    return WriteDrawing(stem, renderer, textured, drawing, sources, options);
  }
};

TEST(WriteDrawing, TheTiffHasTheWallAtItsPlaceAndAWorldFile) {
  const TemporaryFolder folder;
  const SampleWall sample;
  sample.Write(folder / "wall", {"tif"});
  const Image8 picture = ReadSrgb8(folder / "wall.tif");
  ASSERT_EQ(picture.width, 1300);  // 6.5 m in pixels of 5 mm
  ASSERT_EQ(picture.height, 900);
  EXPECT_EQ(*picture.At(49, 450), 255);
  EXPECT_EQ(*picture.At(50, 450), 180);
  EXPECT_EQ(*picture.At(1249, 849), 180);
  EXPECT_EQ(*picture.At(1250, 850), 255);
  // The first pixel's centre: 0.25 m left of the wall, 5.25 m above the model's zero.
  EXPECT_EQ(ReadTextFile(folder / "wall.tfw"), "0.005\n0\n0\n-0.005\n-0.2475\n5.2475\n");
  const auto json = nlohmann::json::parse(ReadTextFile(folder / "wall.json"));
  EXPECT_EQ(json["panels"][0]["normal"], nlohmann::json({0.0, 1.0, 0.0}));  // site: y is south
  EXPECT_EQ(json["pixel_m"], 0.005);
}

TEST(WriteDrawing, GdalReadsPlaceResolutionAndAPlaneThatIsNowhereOnEarth) {
  const TemporaryFolder folder;
  SampleWall().Write(folder / "wall", {"tif"});
  const auto said = Ask({"gdalinfo", folder / "wall.tif"});
  if (!said) GTEST_SKIP() << "gdalinfo is not installed";
  EXPECT_THAT(*said, HasSubstr("Origin = (-0.250000000000000,5.250000000000000)"));
  EXPECT_THAT(*said, HasSubstr("Pixel Size = (0.005000000000000,-0.005000000000000)"));
  EXPECT_THAT(*said, HasSubstr("Groundglass elevation: south wall"));
  EXPECT_THAT(*said, HasSubstr("TIFFTAG_XRESOLUTION=100"));
  EXPECT_THAT(*said, HasSubstr("TIFFTAG_RESOLUTIONUNIT=3"));
  EXPECT_THAT(*said, ::testing::Not(HasSubstr("EPSG\",4")));
}

TEST(WriteDrawing, LayersSayWhichPhotographHowSureAndHowFarBefore) {
  const TemporaryFolder folder;
  SampleWall().Write(folder / "wall", {"layers"});
  const Image16 numbers = ReadLabels(folder / "wall-photographs.tif");
  EXPECT_EQ(*numbers.At(649, 100), 1);  // 3 m from the wall's left end
  EXPECT_EQ(*numbers.At(650, 100), 2);
  EXPECT_EQ(*numbers.At(10, 10), 0);
  EXPECT_EQ(*numbers.At(500, 700), 0);  // the post has no texture
  const SampleWall sample;
  Renderer renderer(sample.textured);
  const DrawingPainter painter(renderer, sample.drawing, MakeGrid(sample.drawing, 0.005));
  const DrawingLayers layers(painter, sample.textured, sample.sources);
  const ImageF sigmas = layers.Sigmas(100, 1);
  EXPECT_FLOAT_EQ(*sigmas.At(600, 0), 0.005f);  // 4 mm of the camera, 3 mm of the model
  EXPECT_TRUE(std::isnan(*sigmas.At(700, 0)));  // nobody says
  const ImageF heights = layers.Heights(700, 1);
  EXPECT_NEAR(*heights.At(500, 0), 1, 1e-6);
  EXPECT_NEAR(*heights.At(600, 0), 0, 1e-6);
  EXPECT_TRUE(std::isnan(*heights.At(10, 0)));
}

TEST(WriteDrawing, SvgAndDxfHaveTheEdgesInMetres) {
  const TemporaryFolder folder;
  SampleWall().Write(folder / "wall", {"svg", "dxf"});
  const std::string svg = ReadTextFile(folder / "wall.svg");
  EXPECT_THAT(svg, HasSubstr("width=\"130mm\" height=\"90mm\" viewBox=\"-0.25 -5.25 6.5 4.5\""));
  const std::string dxf = ReadTextFile(folder / "wall.dxf");
  // The post's right side: u 2.5, from 1.5 to 3 m above zero.
  EXPECT_THAT(dxf,
              HasSubstr("0\nLINE\n8\nOUTLINE\n10\n2.5\n20\n1.5\n30\n0\n11\n2.5\n21\n3\n31\n0\n"));
  if (const auto said = Ask({"ogrinfo", "-al", "-so", folder / "wall.dxf"})) {
    // Eight lines of the wall and the post, and the frame's four.
    EXPECT_THAT(*said, HasSubstr("Feature Count: 12"));
    EXPECT_THAT(*said, HasSubstr("Extent: (-0.250000, 0.750000) - (6.250000, 5.250000)"));
  }
  const auto audit =
      Ask({"/usr/bin/python3",
           "-c",
           "import sys, ezdxf; print(len(ezdxf.readfile(sys.argv[1]).audit().errors))",
           folder / "wall.dxf"});
  const bool is_asked = audit && audit->find("ModuleNotFound") == std::string::npos;
  if (is_asked) {
    EXPECT_EQ(*audit, "0\n");
  }
}

}  // namespace
}  // namespace groundglass
