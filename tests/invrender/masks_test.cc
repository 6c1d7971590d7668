// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "invrender/photos/border_distance.h"
#include "invrender/photos/face_mask.h"
#include "invrender/photos/photo_pyramid.h"
#include "invrender/photos/srgb_codes.h"
#include "invrender/photos/visibility_map.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

const std::string kBrick = std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick";

TEST(MakeFaceMask, IsTheSameAsARayForEachPixel) {
  PolygonModel model;
  AddWall(model, 0, 20, 0, 12);
  AddWall(model, 12, 14, 2, 9, -5);
  AddFace(model, {{6, -3, 0}, {8, 4, 0}, {8, 4, 10}, {6, -3, 10}});  // cuts through the wall
  AddFace(model, {{-40, -40, 0}, {60, -40, 0}, {60, 40, 0}, {-40, 40, 0}});  // under the camera
  const Visibility visibility(model);
  for (const double k1 : {0.0, -0.15, 0.1}) {
    Camera camera = LookAt({3, -14, 5}, {10, 0, 5}, 203, 151, 120);
    camera.k1 = k1;
    const Image16 mask = MakeFaceMask(model, visibility, camera);
    EXPECT_TRUE(mask.values == visibility.FaceLabels(camera).values) << k1;
  }
}

TEST(MakeFaceMask, AgreesWithTheTruthOfTheBrickScene) {
  const PolygonModel model = ReadOsu(kBrick + "/model.osu").model;
  const Visibility visibility(model);
  for (const NamedCamera& named : ReadColmapModel(kBrick + "/truth/cameras")) {
    const std::string stem = std::filesystem::path(named.name).stem().string();
    const Image16 truth = ReadLabels(kBrick + "/truth/masks_model/" + stem + ".png");
    const Image16 mask = MakeFaceMask(model, visibility, named.camera);
    ASSERT_EQ(mask.values.size(), truth.values.size());
    size_t num_different = 0;
    for (size_t i = 0; i < mask.values.size(); ++i) {
      num_different += mask.values[i] != truth.values[i] ? 1 : 0;
    }
    EXPECT_LT(static_cast<double>(num_different), 0.004 * static_cast<double>(mask.values.size()))
        << named.name;
  }
}

TEST(ComputeBorderDistance, CountsPixelsToWhereAnotherSurfaceBegins) {
  PolygonModel model;
  AddWall(model, -100, 100, -100, 100);
  AddWall(model, 0, 100, -100, 100, -10);  // hides the right half of the picture
  const Camera camera = LookAt({-0.001, -30, 0}, {-0.001, 0, 0}, 64, 48, 40);
  const Image16 labels = MakeFaceMask(model, Visibility(model), camera);
  const Image8 border = ComputeBorderDistance(model, camera, labels, {0, 1}, {});
  for (int x = 2; x < 62; ++x) {
    const double expected = std::abs(x + 0.5 - 32);
    EXPECT_NEAR(*border.At(x, 24) / kBorderStepsPerPx,
                std::min(expected, kFarthestBorder / kBorderStepsPerPx),
                0.2)
        << x;
  }
}

TEST(VisibilityMap, AnswersAsThePicturesThatItWasMadeOf) {
  Image16 labels(37, 21, 1);  // no multiple of its tiles
  Image8 border(37, 21, 1, 60);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x) {
      *labels.At(x, y) = static_cast<uint16_t>(x < 20 ? 3 : y < 11 ? 5 : 0);
      if (x >= 18) *border.At(x, y) = static_cast<uint8_t>(x + y);
    }
  }
  const VisibilityMap map(labels, border, 50);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x) {
      ASSERT_EQ(map.At(x, y).label, *labels.At(x, y));
      ASSERT_EQ(map.At(x, y).border, std::min<int>(*border.At(x, y), 50));
    }
  }
  EXPECT_THAT(map.ShownFaces(6), testing::ElementsAre(0, 0, 1, 0, 1, 0));
}

TEST(VisibilityMap, TakesLittleHoweverManyFacesMeetInATile) {
  // Tiles with one to seven faces and with one distance or many.
  Image16 labels(56, 16, 1);
  Image8 border(56, 16, 1, 9);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 56; ++x) {
      *labels.At(x, y) = static_cast<uint16_t>(40000 + (x + 3 * y) % (1 + x / 8));
      if (y >= 8) *border.At(x, y) = static_cast<uint8_t>(x % 8 + y);
    }
  }
  const VisibilityMap map(labels, border, 50);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 56; ++x) {
      ASSERT_EQ(map.At(x, y), (VisibilityMap::Pixel{*labels.At(x, y), *border.At(x, y)})) << x << y;
    }
  }
  EXPECT_EQ(map.NumTileBytes(), 4u * 14);
  // Labels: 1, 2, 4 and 4 of a palette with 0, 8, 16 and 16 bytes, then 64 of two bytes.
  const size_t above = 13 + 2 * 25 + 3 * 129;
  EXPECT_LE(map.NumBytes(), 4 * 14 + 6 * 4 + above + 7 * 66 + 3 + 12 + 2 * 24 + 3 * 128);
}

TEST(FindMount, FindsTheDarkRimAndLeavesDarkWindowsAlone) {
  Image8 slide(300, 200, 3, 120);
  const auto fill = [&](int x0, int y0, int x1, int y1, uint8_t value) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) std::fill_n(slide.At(x, y), 3, value);
    }
  };
  fill(0, 0, 9, 200, 6);       // mount on the left
  fill(0, 194, 300, 200, 6);   // and below
  fill(100, 80, 140, 120, 6);  // a window
  fill(290, 50, 300, 90, 6);   // something dark that reaches the frame
  const Image8 mount = FindMount(slide);
  EXPECT_EQ(*mount.At(4, 100), 255);
  EXPECT_EQ(*mount.At(10, 100), 255);  // the blurred edge
  EXPECT_EQ(*mount.At(16, 100), 0);
  EXPECT_EQ(*mount.At(200, 196), 255);
  EXPECT_EQ(*mount.At(200, 185), 0);
  EXPECT_EQ(*mount.At(120, 100), 0);
  EXPECT_EQ(*mount.At(298, 70), 0);
}

TEST(PhotoPyramid, KeepsAConstantAndFindsPixelCentresExactly) {
  Image8 image(40, 30, 3, 77);
  *image.At(11, 7) = 200;
  const PhotoPyramid pyramid(image);
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  EXPECT_NEAR(pyramid.Sample({11.5, 7.5}, one)[0], RadianceOfCodes<uint8_t>()[200], 1e-6);
  EXPECT_NEAR(pyramid.Sample({11.5, 7.5}, one)[1], RadianceOfCodes<uint8_t>()[77], 1e-6);
  EXPECT_NEAR(pyramid.Sample({25.2, 18.9}, 9 * one)[0], RadianceOfCodes<uint8_t>()[77], 1e-3);
  // Half a pixel beside it, the bright pixel is one of the two in the middle: 9/16.
  const float expected =
      RadianceOfCodes<uint8_t>()[77] +
      0.5625f * (RadianceOfCodes<uint8_t>()[200] - RadianceOfCodes<uint8_t>()[77]);
  EXPECT_NEAR(pyramid.Sample({12.0, 7.5}, one)[0], expected, 1e-6);
}

TEST(Srgb8FromRadiance, InvertsEveryCode) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(Srgb8FromRadiance(RadianceOfCodes<uint8_t>()[code]), code);
  }
}

// A wall with a red patch that stands for a passer-by.
struct PatchedWall {
  TemporaryFolder folder;
  PolygonModel model;
  Camera camera = LookAt({10, -24, 5}, {10, 0, 6}, 320, 240, 280);
  BakePhotograph photograph;

  PatchedWall() {
    AddWall(model, 0, 20, 0, 12);
    const Paint grey = [](int, const Eigen::Vector3d&) { return Eigen::Array3f::Constant(0.3f); };
    photograph = PhotographPainted(
        model, camera, grey, folder.path(), "s1", [](const Eigen::Array3f& radiance, int x, int y) {
          return IsPatch(x, y) ? Eigen::Array3f(0.9f, 0.1f, 0.1f) : radiance;
        });
  }
  static bool IsPatch(int x, int y) { return x >= 140 && x < 180 && y >= 100 && y < 140; }
};

TEST(BakeTextures, WhiteInAMaskIsIgnored) {
  PatchedWall wall;
  Image8 mask(320, 240, 1);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      // A pixel wider than the patch.
      *mask.At(x, y) = x >= 139 && x < 181 && y >= 99 && y < 141 ? 255 : 0;
    }
  }
  wall.photograph.mask_file = wall.folder / "mask.png";
  WriteSrgb8(*wall.photograph.mask_file, mask);
  // Texels as large as the camera's pixels, and as fine as the bake chooses: the same area is open.
  for (const double texel_size : {24.0 / 280, 0.0}) {
    BakeOptions options;
    options.pages.texel_size = texel_size;
    const BakeResult result = BakeTextures(wall.model, std::vector{wall.photograph}, options);
    const double px_of_texel = result.coverage.faces[0].texel_size * 280 / 24;
    double open_px = 0;
    for (const PlacedTexel& texel : TexelsOf(result.model, 0)) {
      open_px += texel.source == 0 ? px_of_texel * px_of_texel : 0;
      if (texel.source != 0) {
        ASSERT_NEAR(texel.radiance[0], 0.3, 0.03);
      }
    }
    EXPECT_NEAR(open_px, 42 * 42, 42 * 8) << texel_size;
  }
}

TEST(BakeTextures, HandPaintedFacesReplaceTheAutomaticMask) {
  PatchedWall wall;
  Image16 faces = MakeFaceMask(wall.model, Visibility(wall.model), wall.camera);
  for (int y = 0; y < 240; ++y) {
    for (int x = 150; x < 320; ++x) *faces.At(x, y) = 0;
  }
  wall.photograph.faces_file = wall.folder / "painted.png";
  WriteLabels(*wall.photograph.faces_file, faces);
  const BakeResult result = BakeTextures(wall.model, std::vector{wall.photograph});
  for (const PlacedTexel& texel : TexelsOf(result.model, 0)) {
    const auto px = Project(wall.camera, texel.point_in_world);
    ASSERT_TRUE(px);
    if (px->x() > 150.5) {
      ASSERT_EQ(texel.source, 0);
    } else if (px->x() < 149) {
      ASSERT_EQ(texel.source, 1);
    }
  }
}

TEST(BakeTextures, PhotographTexturesOnlyTheFacesItMay) {
  PatchedWall wall;
  AddWall(wall.model, 21, 22, 0, 12);
  wall.photograph.faces = std::vector<int>{1};
  const BakeResult result = BakeTextures(wall.model, std::vector{wall.photograph});
  EXPECT_EQ(result.coverage.faces[0].num_covered_texels, 0);
}

}  // namespace
}  // namespace groundglass
