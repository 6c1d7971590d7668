// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/renderer.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/srgb.h"
#include "scene/visibility.h"
#include "tests/viewer/sample_models.h"
#include "viewer/camera_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// A wall of 64 x 32 that fills a frame of 64 x 32 exactly: one texel, one pixel.
Camera FrontalCamera() { return MakeCamera({32, -100, 16}, {32, 0, 16}, 64, 32, 100); }

TEST(Renderer, FrontalCheckerFallsOnExactPixels) {
  const Image8 page = MakeCheckerPage(64, 32);
  const Image8 picture = Render(MakeWall(64, 32, page), FrontalCamera());
  EXPECT_EQ(picture.values, page.values);
}

TEST(Renderer, MagnifiedCheckerKeepsItsTexelsCentres) {
  // Sixteen pixels a texel: at a texel's centre the picture has its colour, half-way between two
  // texels half the light of both.
  const Camera camera = ResizedCamera(FrontalCamera(), 1024, 512);
  for (const int supersampling : {1, 2}) {
    RenderOptions options;
    options.supersampling = supersampling;
    const Image8 picture = Render(MakeWall(64, 32, MakeCheckerPage(64, 32)), camera, options);
    for (const auto& [column, row] : {std::pair{1, 1}, {5, 2}, {40, 20}, {62, 30}}) {
      const bool is_white = (column + row) % 2 == 0;
      // The pixels around the texel's centre and around the middle of its right border.
      EXPECT_NEAR(*picture.At(16 * column + 8, 16 * row + 8), is_white ? 255 : 0, 70);
      const int before = *picture.At(16 * column + 15, 16 * row + 8);
      const int after = *picture.At(16 * column + 16, 16 * row + 8);
      EXPECT_GT(is_white ? before - after : after - before, 5);
      EXPECT_NEAR((before + after) / 2.0, 188, 3);
    }
  }
}

TEST(Renderer, TwoRenderersGiveTheSameBytes) {
  const TexturedModel box = MakeCheckeredBox();
  const Camera camera = MakeCamera({7, -6, 4}, {0, 0, 0}, 320, 240, 300);
  RenderOptions options;
  options.background = Background::kSky;
  options.edges = true;
  EXPECT_EQ(Render(box, camera, options).values, Render(box, camera, options).values);
}

TEST(Renderer, RepeatsItselfAfterOtherPictures) {
  Renderer renderer(MakeCheckeredBox());
  const Camera camera = MakeCamera({7, -6, 4}, {0, 0, 0}, 320, 240, 300);
  Camera bent = ResizedCamera(camera, 200, 200);
  bent.k1 = -0.1;
  const Image8 first = renderer.Render(camera);
  RenderOptions shaded;
  shaded.mode = DrawMode::kShaded;
  shaded.supersampling = 2;
  renderer.Render(bent, shaded);
  renderer.RenderLabels(bent);
  EXPECT_EQ(renderer.Render(camera).values, first.values);
}

TEST(Renderer, BackFacesArePlainGreyInEveryMode) {
  const TexturedModel wall = MakeWall(64, 32, MakeCheckerPage(64, 32));
  const Camera behind = MakeCamera({32, 100, 16}, {32, 0, 16}, 64, 32, 100);
  const int grey = static_cast<int>(std::lround(255 * SrgbFromLinear(0.30f)));
  for (const DrawMode mode : {DrawMode::kTextured, DrawMode::kShaded}) {
    RenderOptions options;
    options.mode = mode;
    const Image8 picture = Render(wall, behind, options);
    for (const uint8_t value : picture.values) ASSERT_NEAR(value, grey, 1);
  }
}

TEST(Renderer, DistantCheckerIsGreyOfHalfTheLight) {
  // 1024 x 1024 squares seen at 1/16: every pixel shows as much white as black, and half the light
  // is sRGB 188, not 128.
  const TexturedModel wall = MakeWall(1024, 1024, MakeCheckerPage(1024, 1024));
  const Image8 picture = Render(wall, MakeCamera({512, -1000, 512}, {512, 0, 512}, 64, 64, 62.5));
  EXPECT_NEAR(*picture.At(32, 32), 188, 2);
  EXPECT_NEAR(*picture.At(10, 50), 188, 2);
}

TEST(Renderer, TapsAlongTheLineOfSightKeepSlantedStripesApart) {
  // Level stripes of 8 texels on a wall that runs away from the viewer: narrow across, not down.
  Image8 page(512, 512, 3);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512 * 3; ++x) {
      page.values[static_cast<size_t>(y) * 512 * 3 + x] = y / 8 % 2 == 0 ? 255 : 0;
    }
  }
  const TexturedModel wall = MakeWall(512, 512, page);
  const Camera camera = MakeCamera({-200, -40, 256}, {256, 0, 256}, 64, 256, 200);
  const auto contrast = [&](int anisotropy) {
    RenderOptions options;
    options.anisotropy = anisotropy;
    const Image8 picture = Render(wall, camera, options);
    int least = 255;
    int most = 0;
    for (int y = 100; y < 156; ++y) {
      least = std::min<int>(least, *picture.At(32, y));
      most = std::max<int>(most, *picture.At(32, y));
    }
    return most - least;
  };
  EXPECT_LT(contrast(1), 120);
  EXPECT_GT(contrast(16), 200);
}

// The border of a black wall crosses pixels at half their width.
Image8 RenderHalfCoveredPixels(const RenderOptions& options) {
  Camera camera = FrontalCamera();
  camera.center_x_px += 8.5;
  return Render(MakeWall(64, 32, MakePlainPage(8, 8, 0, 0, 0)), camera, options);
}

TEST(Renderer, BordersAverageLightNotCodes) {
  RenderOptions options;
  for (const auto& [multisamples, supersampling] : {std::pair{4, 1}, {1, 2}, {4, 2}}) {
    options.multisamples = multisamples;
    options.supersampling = supersampling;
    const Image8 picture = RenderHalfCoveredPixels(options);
    EXPECT_EQ(*picture.At(7, 16), 255);
    EXPECT_NEAR(*picture.At(8, 16), 188, 2) << multisamples << " " << supersampling;
    EXPECT_EQ(*picture.At(9, 16), 0);
  }
}

TEST(Renderer, TransparentBordersKeepTheFacesColour) {
  Camera camera = FrontalCamera();
  camera.center_x_px += 8.5;
  RenderOptions options;
  options.background = Background::kTransparent;
  const Image8 picture =
      Render(MakeWall(64, 32, MakePlainPage(8, 8, 200, 100, 50)), camera, options);
  ASSERT_EQ(picture.channels, 4);
  EXPECT_EQ(picture.At(7, 16)[3], 0);
  EXPECT_NEAR(picture.At(8, 16)[3], 128, 2);
  EXPECT_NEAR(picture.At(8, 16)[0], 200, 3);
  EXPECT_NEAR(picture.At(8, 16)[1], 100, 3);
  EXPECT_NEAR(picture.At(8, 16)[2], 50, 3);
  EXPECT_EQ(picture.At(9, 16)[3], 255);
}

// Small squares scattered in front of the camera, each facing it: the centre of the ink of each is
// where its centre is projected.
void ExpectSquaresWhereProjected(const Camera& camera, const RenderOptions& options) {
  TexturedModel squares;
  std::vector<Eigen::Vector3d> centers_in_world;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      const Eigen::Vector2d at_px((column + 0.6) * camera.width_px / 5.2,
                                  (row + 0.6) * camera.height_px / 4.2);
      const double depth = 40 + 7 * column + 3 * row;
      const Eigen::Vector3d center_in_cam = depth * UnprojectToCam(camera, at_px);
      const double half = 5 * depth / camera.focal_x_px;
      const int first = static_cast<int>(squares.model.points_in_world.size());
      for (const auto& [x, y] : {std::pair{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}) {
        squares.model.points_in_world.push_back(
            Inverse(camera.cam_from_world) *
            Eigen::Vector3d(center_in_cam + Eigen::Vector3d(x * half, y * half, 0)));
      }
      squares.model.faces.push_back({{first, first + 1, first + 2, first + 3}, ""});
      squares.faces.push_back({0, {{0, 4}, {4, 4}, {4, 0}, {0, 0}}});
      centers_in_world.push_back(Inverse(camera.cam_from_world) * center_in_cam);
    }
  }
  squares.pages = {{MakePlainPage(4, 4, 0, 0, 0), {}}};
  const Image8 picture = Render(squares, camera, options);
  for (const Eigen::Vector3d& center_in_world : centers_in_world) {
    const Eigen::Vector2d expected_px = *Project(camera, center_in_world);
    Eigen::Vector2d sum_px = Eigen::Vector2d::Zero();
    double ink = 0;
    for (int y = static_cast<int>(expected_px.y()) - 12; y < expected_px.y() + 12; ++y) {
      for (int x = static_cast<int>(expected_px.x()) - 12; x < expected_px.x() + 12; ++x) {
        if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
        const double dark = 1 - LinearFromSrgb(*picture.At(x, y) / 255.0f);
        sum_px += dark * Eigen::Vector2d(x + 0.5, y + 0.5);
        ink += dark;
      }
    }
    ASSERT_GT(ink, 20);
    EXPECT_NEAR((sum_px / ink - expected_px).norm(), 0, 0.1) << expected_px.transpose();
  }
}

Camera OffCentreCamera() {
  Camera camera = MakeCamera({50, -80, 5}, {0, 0, 12}, 640, 420, 600);
  camera.center_x_px = 371.3;
  camera.center_y_px = 188.6;
  camera.focal_y_px = 671.7;  // pixels that are not square
  return camera;
}

TEST(Renderer, OffCentrePrincipalPointAndOblongPixelsHold) {
  ExpectSquaresWhereProjected(OffCentreCamera(), {});
}

TEST(Renderer, DistortionHolds) {
  for (const double k1 : {-0.2, -0.018, 0.15}) {
    Camera camera = OffCentreCamera();
    camera.k1 = k1;
    camera.k2 = 0.02;
    RenderOptions options;
    options.supersampling = 2;
    ExpectSquaresWhereProjected(camera, options);
  }
}

// How many pixels' labels differ, not counting pixels that touch a border of either picture.
int CountDifferencesOffBorders(const Image16& a, const Image16& b) {
  int count = 0;
  for (int y = 1; y + 1 < a.height; ++y) {
    for (int x = 1; x + 1 < a.width; ++x) {
      bool is_border = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          is_border |= *a.At(x + dx, y + dy) != *a.At(x, y);
          is_border |= *b.At(x + dx, y + dy) != *b.At(x, y);
        }
      }
      if (!is_border && *a.At(x, y) != *b.At(x, y)) ++count;
    }
  }
  return count;
}

TEST(Renderer, LabelsAreThoseOfTheVisibilityEngine) {
  TexturedModel brick;
  brick.model =
      ReadModel(std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/model.osu").model;
  Renderer renderer(brick);
  const Visibility visibility(brick.model);
  OrbitOptions orbit;
  orbit.width_px = 600;
  orbit.height_px = 400;
  std::vector<Camera> cameras = MakeOrbit(brick.model, 3, orbit);
  cameras[1].k1 = -0.1;
  cameras[2].center_x_px += 60.3;
  // One inside the building, with walls beside and behind it.
  const Eigen::Vector3d middle = ComputeBounds(brick.model).Center();
  cameras.push_back(MakeCamera(middle, middle + Eigen::Vector3d(3, 1, 0.2), 600, 400, 400));
  for (const Camera& camera : cameras) {
    EXPECT_EQ(
        CountDifferencesOffBorders(renderer.RenderLabels(camera), visibility.FaceLabels(camera)),
        0);
  }
}

TEST(Renderer, PagesTooLargeAreHalvedAndSaidToBe) {
  const TexturedModel wall = MakeWall(64, 32, MakePlainPage(64, 32, 200, 100, 50));
  RendererOptions options;
  options.max_page_size_px = 40;
  Renderer renderer(wall, options);
  EXPECT_THAT(renderer.Warnings(),
              testing::ElementsAre(testing::HasSubstr("page 1 is shown at 32 x 16 in place of "
                                                      "64 x 32")));
  EXPECT_EQ(*renderer.Render(FrontalCamera()).At(20, 20), 200);
}

TEST(Renderer, WireframeHidesHiddenLines) {
  RenderOptions options;
  options.mode = DrawMode::kWireframe;
  // Seen straight on, the box's back edges and the lines into depth lie inside the front face.
  const Camera camera = MakeCamera({0, -11.5, 0}, {0, 0, 0}, 100, 100, 100);
  const Image8 picture = Render(MakeCheckeredBox(), camera, options);
  EXPECT_LT(*picture.At(30, 50), 100);  // the front face's left edge, at 50 - 100 * 2 / 10
  for (int x = 33; x < 67; ++x) EXPECT_EQ(*picture.At(x, 50), 255) << x;
}

TEST(Renderer, OptionsOutOfRangeAreNamed) {
  RenderOptions options;
  options.supersampling = 9;
  try {
    Render(MakeCheckeredBox(), FrontalCamera(), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("supersampling must be from 1 to 4"));
  }
}

TEST(Renderer, TextureWithoutItsPageIsNamed) {
  TexturedModel wall = MakeWall(64, 32, MakePlainPage(8, 8, 0, 0, 0));
  wall.faces[0].page = 3;
  try {
    Renderer renderer(wall);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("face 1 (wall) is on texture page 3"));
  }
}

}  // namespace
}  // namespace groundglass
