// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"
#include "scene/textured_model.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace groundglass {
namespace {

// The photographs as they are: for tests of geometry.
BakeOptions Plain() {
  BakeOptions options;
  options.match_colour = false;
  options.reject_occluders = false;
  return options;
}

// How far the texture lies from where it should, in texels, as an affine map: texture(p) =
// truth(p + shift + linear * (p - centre)). Least squares on the truth's gradient. Texels beside
// the face's border are left out: they repeat the clean ones farther in.
struct Displacement {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Matrix2d linear = Eigen::Matrix2d::Zero();  // per 100 texels
  double rms = 0;                                    // radiance, before the fit
};
Displacement MeasureDisplacement(const std::vector<PlacedTexel>& texels) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const PlacedTexel& texel : texels) centre += texel.point_in_world / texels.size();
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  Displacement displacement;
  double count = 0;
  for (const PlacedTexel& texel : texels) {
    if (texel.source == 0 || texel.texels_from_border < 5) continue;
    const Eigen::Vector3d& p = texel.point_in_world;
    const Eigen::Array3f gx =
        (Waves(p + texel.right_in_world) - Waves(p - texel.right_in_world)) / 2;
    const Eigen::Array3f gy = (Waves(p + texel.down_in_world) - Waves(p - texel.down_in_world)) / 2;
    const Eigen::Vector2d from_centre(
        (p - centre).dot(texel.right_in_world) / texel.right_in_world.squaredNorm() / 100,
        (p - centre).dot(texel.down_in_world) / texel.down_in_world.squaredNorm() / 100);
    const Eigen::Array3f error = texel.radiance - Waves(p);
    for (int c = 0; c < 3; ++c) {
      Eigen::Matrix<double, 6, 1> row;
      row << gx[c], gy[c], gx[c] * from_centre, gy[c] * from_centre;
      normal += row * row.transpose();
      right += row * error[c];
      displacement.rms += error[c] * error[c];
      ++count;
    }
  }
  const Eigen::Matrix<double, 6, 1> solution = normal.ldlt().solve(right);
  displacement.shift = solution.head<2>();
  displacement.linear.row(0) = solution.segment<2>(2);
  displacement.linear.row(1) = solution.segment<2>(4);
  displacement.rms = std::sqrt(displacement.rms / count);
  return displacement;
}

void ExpectInPlace(const std::vector<PlacedTexel>& texels) {
  ASSERT_GT(texels.size(), 1000u);
  const Displacement displacement = MeasureDisplacement(texels);
  EXPECT_LT(displacement.shift.norm(), 0.04);
  EXPECT_LT(displacement.linear.norm(), 0.04) << displacement.linear;
  EXPECT_LT(displacement.rms, 0.006);
}

TEST(BakeTextures, LongWallGetsAllThatFivePhotographsShow) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 200, 0, 20);
  std::vector<BakePhotograph> photographs;
  // Near the wall, turned this way and that: none shows it whole, and some of it nobody shows.
  for (int i = 0; i < 5; ++i) {
    const Camera camera =
        LookAt({20.0 + 38 * i, -25, 6}, {24.0 + 38 * i + 6 * (i % 2), 0, 9}, 320, 240, 250);
    photographs.push_back(
        PhotographPainted(model, camera, kWaves, folder.path(), "s" + std::to_string(i + 1)));
  }
  const BakeResult result = BakeTextures(model, photographs, Plain());
  long num_seen = 0;
  long num_unseen = 0;
  long num_filled = 0;
  for (const PlacedTexel& texel : TexelsOf(result.model, wall)) {
    double deepest = -1;  // how far inside a frame the texel lies, px
    for (const BakePhotograph& photograph : photographs) {
      const auto px = Project(photograph.camera, texel.point_in_world);
      if (!px) continue;
      deepest = std::max(deepest, std::min({px->x(), px->y(), 320 - px->x(), 240 - px->y()}));
    }
    if (deepest > 4) {
      ++num_seen;
      ASSERT_NE(texel.source, kProvenanceNone) << texel.point_in_world.transpose();
      ASSERT_NE(texel.source, kProvenanceFilled) << texel.point_in_world.transpose();
      // The last texels before the border repeat those farther in.
      ASSERT_LT((texel.radiance - Waves(texel.point_in_world)).abs().maxCoeff(),
                texel.texels_from_border < 5 ? 0.12f : 0.06f)
          << texel.point_in_world.transpose();
    } else if (deepest < 0) {
      ++num_unseen;
      if (texel.source == kProvenanceFilled) {  // in a slit beside the wall's border
        ++num_filled;
        ASSERT_LT(texel.texels_from_border, 3) << texel.point_in_world.transpose();
        continue;
      }
      ASSERT_EQ(texel.source, kProvenanceNone) << texel.point_in_world.transpose();
      ASSERT_NEAR(texel.radiance.maxCoeff(), LinearFromSrgb(kNoPhotographSrgb8 / 255.0f), 1e-3);
      ASSERT_EQ(texel.radiance.minCoeff(), texel.radiance.maxCoeff());
    }
  }
  EXPECT_GT(num_seen, 50000);
  EXPECT_GT(num_unseen, 1000);
  EXPECT_LT(num_filled, num_unseen / 20);
  EXPECT_EQ(result.coverage.faces[wall].sources.size(), 5u);
  const double share = static_cast<double>(num_seen) / (num_seen + num_unseen);
  EXPECT_NEAR(result.coverage.CoveredShare(), share, 0.03);
  ExpectInPlace(TexelsOf(result.model, wall));
}

TEST(BakeTextures, ObliqueViewIsNeitherShiftedNorSheared) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 30, 0, 12);
  const Camera camera = LookAt({-8, -20, 5}, {13, 0, 6}, 640, 400, 520);
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, kWaves, folder.path(), "oblique")};
  ExpectInPlace(TexelsOf(BakeTextures(model, photographs, Plain()).model, wall));
}

TEST(BakeTextures, DistortedLensAndOblongPixelsAreFollowedExactly) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 24, 0, 12);
  Camera camera = LookAt({10, -22, 7}, {12, 0, 6}, 640, 400, 500);
  camera.focal_y_px = 380;
  camera.center_x_px = 331;
  camera.center_y_px = 190;
  camera.k1 = -0.12;
  camera.k2 = 0.02;
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, kWaves, folder.path(), "ntsc")};
  ExpectInPlace(TexelsOf(BakeTextures(model, photographs, Plain()).model, wall));
}

TEST(BakeTextures, FinePhotographsAreAveragedIntoCoarseTexels) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 32, 0, 16);
  // A checkerboard of quarter feet, far finer than the texels: its mean is all that may be left.
  const Paint checks = [](int, const Eigen::Vector3d& p) {
    const int parity = static_cast<int>(std::floor(4 * p.x()) + std::floor(4 * p.z())) & 1;
    return Eigen::Array3f::Constant(parity ? 0.6f : 0.1f);
  };
  const Camera camera = LookAt({16, -30, 8}, {16, 0, 8}, 640, 400, 540);
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, checks, folder.path(), "fine")};
  BakeOptions options = Plain();
  options.pages.texel_size = 1;
  const BakeResult result = BakeTextures(model, photographs, options);
  for (const PlacedTexel& texel : TexelsOf(result.model, wall)) {
    if (texel.source == 0) continue;
    EXPECT_NEAR(texel.radiance[0], 0.35, 0.05) << texel.point_in_world.transpose();
  }
}

TEST(BakeTextures, PillarIsNotPrintedOnTheWallBehindIt) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 30, 0, 12);
  const int pillar = AddWall(model, 14, 16, 0, 12, -4);
  AddFace(model, {{14, 0, 0}, {14, -4, 0}, {14, -4, 12}, {14, 0, 12}});
  AddFace(model, {{16, -4, 0}, {16, 0, 0}, {16, 0, 12}, {16, -4, 12}});
  const Paint paint = [&](int face, const Eigen::Vector3d& point) -> Eigen::Array3f {
    return face == wall ? Eigen::Array3f(0.1f, 0.3f, 0.3f + 0.01f * static_cast<float>(point.x()))
                        : Eigen::Array3f(0.9f, 0.05f, 0.05f);
  };
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(
          model, LookAt({6, -24, 6}, {14, 0, 6}, 480, 320, 330), paint, folder.path(), "a"),
      PhotographPainted(
          model, LookAt({24, -24, 6}, {16, 0, 6}, 480, 320, 330), paint, folder.path(), "b")};
  const BakeResult result = BakeTextures(model, photographs, Plain());
  long num_covered = 0;
  for (const PlacedTexel& texel : TexelsOf(result.model, wall)) {
    if (texel.source == 0) continue;
    ++num_covered;
    ASSERT_LT(texel.radiance[0], 0.14f) << texel.point_in_world.transpose();
  }
  // All of the wall but what stands inside the pillar.
  EXPECT_NEAR(result.coverage.faces[wall].covered_area, 30 * 12 - 2 * 12, 5);
  EXPECT_GT(num_covered, 10000);
  for (const PlacedTexel& texel : TexelsOf(result.model, pillar)) {
    ASSERT_GT(texel.radiance[0], 0.8f) << texel.point_in_world.transpose();
  }
}

TEST(BakeTextures, SkyBesideAnEdgeDoesNotBleedOntoTheWallWhenTheTagIsAPixelOff) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 20, 0, 12);
  const Paint dark = [](int, const Eigen::Vector3d&) { return Eigen::Array3f::Constant(0.1f); };
  const Camera camera = LookAt({10, -24, 5}, {10, 0, 6}, 480, 320, 400);
  BakePhotograph photograph = PhotographPainted(model, camera, dark, folder.path(), "s1");
  photograph.camera.center_x_px += 1;
  for (const PlacedTexel& texel :
       TexelsOf(BakeTextures(model, std::vector{photograph}, Plain()).model, wall)) {
    ASSERT_NE(texel.source, 0);
    ASSERT_LT(texel.radiance[0], 0.2f) << texel.point_in_world.transpose();
  }
}

TEST(BakeTextures, ConcaveFacesAndManyCornersAreKept) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int angle =
      AddFace(model, {{0, 0, 0}, {12, 0, 0}, {12, 0, 4}, {4, 0, 4}, {4, 0, 12}, {0, 0, 12}});
  std::vector<Eigen::Vector3d> ring;
  for (int i = 0; i < 17; ++i) {
    const double turn = 2 * M_PI * i / 17;
    ring.emplace_back(18 + 5 * std::cos(turn), 0.5, 6 + 5 * std::sin(turn));
  }
  const int disc = AddFace(model, ring);
  const Camera camera = LookAt({12, -30, 6}, {11, 0, 6}, 640, 400, 700);
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, kWaves, folder.path(), "s1")};
  const BakeResult result = BakeTextures(model, photographs, Plain());
  for (const int face : {angle, disc}) {
    EXPECT_NEAR(result.coverage.faces[face].covered_area, ComputeFaceArea(model, face), 1e-9);
    ExpectInPlace(TexelsOf(result.model, face));
  }
}

TEST(BakeTextures, TJunctionsLeaveNoGap) {
  const TemporaryFolder folder;
  PolygonModel model;
  // One tall wall beside two low ones in its plane, whose shared corner lies on its edge; a third
  // plane meets them all at an angle.
  AddWall(model, 0, 8, 0, 12);
  AddWall(model, 8, 16, 0, 5);
  AddWall(model, 8, 16, 5, 12);
  AddFace(model, {{16, 0, 0}, {22, 5, 0}, {22, 5, 12}, {16, 0, 12}});
  const Camera camera = LookAt({11, -28, 6}, {11, 0, 6}, 640, 400, 640);
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, kWaves, folder.path(), "s1")};
  const BakeResult result = BakeTextures(model, photographs, Plain());
  EXPECT_NEAR(result.coverage.CoveredShare(), 1, 1e-9);
  for (int face = 0; face < 4; ++face) {
    for (const PlacedTexel& texel : TexelsOf(result.model, face)) {
      ASSERT_LT((texel.radiance - Waves(texel.point_in_world)).abs().maxCoeff(), 0.1f);
    }
  }
}

TEST(BakeTextures, FaceThatNoPhotographShowsStaysAndIsReported) {
  const TemporaryFolder folder;
  PolygonModel model;
  AddWall(model, 0, 10, 0, 10);
  const int back = AddFace(model, {{10, 1, 0}, {0, 1, 0}, {0, 1, 10}, {10, 1, 10}});
  const Camera camera = LookAt({5, -20, 5}, {5, 0, 5}, 320, 240, 300);
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, kWaves, folder.path(), "s1")};
  const BakeResult result = BakeTextures(model, photographs, Plain());
  ASSERT_EQ(result.model.faces.size(), 2u);
  EXPECT_EQ(result.model.faces[back].page, -1);
  EXPECT_EQ(result.coverage.faces[back].covered_area, 0);
  EXPECT_EQ(result.coverage.faces[back].area, 100);
  EXPECT_TRUE(result.coverage.faces[back].sources.empty());
  // Whoever stands behind the wall can photograph it.
  EXPECT_FALSE(result.coverage.faces[0].missing);
  ASSERT_TRUE(result.coverage.faces[back].missing);
  EXPECT_LT(
      (result.coverage.faces[back].missing->centre_in_world - Eigen::Vector3d(5, 1, 5)).norm(),
      1e-9);
  ASSERT_TRUE(result.coverage.faces[back].missing->stand_in_world);
  EXPECT_GT(result.coverage.faces[back].missing->stand_in_world->y(), 5);
  EXPECT_NEAR(result.coverage.faces[back].missing->stand_in_world->z(), 5.5, 1e-9);
  EXPECT_THAT(FormatCoverage(result.coverage), testing::HasSubstr("stand_at"));
  EXPECT_EQ(BakeTextures(model, {}, Plain()).coverage.CoveredShare(), 0);
}

TEST(BakeTextures, ThreadsDoNotChangeAByte) {
  const TemporaryFolder folder;
  PolygonModel model;
  AddWall(model, 0, 20, 0, 10);
  AddFace(model, {{20, 0, 0}, {28, 6, 0}, {28, 6, 10}, {20, 0, 10}});
  std::vector<BakePhotograph> photographs;
  for (int i = 0; i < 4; ++i) {
    const Camera camera = LookAt({4.0 + 6 * i, -22, 5}, {10.0 + 3 * i, 0, 5}, 320, 240, 260);
    photographs.push_back(
        PhotographPainted(model, camera, kWaves, folder.path(), "s" + std::to_string(i)));
  }
  std::vector<BakeResult> results;
  for (const size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(BakeTextures(model, photographs));
  }
  ASSERT_EQ(results[0].model.pages.size(), results[1].model.pages.size());
  for (size_t i = 0; i < results[0].model.pages.size(); ++i) {
    EXPECT_TRUE(results[0].model.pages[i].srgb8.values == results[1].model.pages[i].srgb8.values);
    EXPECT_TRUE(results[0].model.pages[i].provenance.values ==
                results[1].model.pages[i].provenance.values);
  }
  EXPECT_EQ(FormatCoverage(results[0].coverage), FormatCoverage(results[1].coverage));
}

TEST(BakeTextures, SmallPagesAreManyAndHoldEverything) {
  const TemporaryFolder folder;
  PolygonModel model;
  for (int i = 0; i < 6; ++i) AddWall(model, 4.0 * i, 4.0 * i + 3, 0, 12, 0.3 * i);
  const Camera camera = LookAt({12, -26, 6}, {12, 0, 6}, 640, 400, 560);
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, kWaves, folder.path(), "s1")};
  BakeOptions options = Plain();
  options.pages.max_page_texels = 256;
  options.pages.texel_size = 0.06;
  const BakeResult result = BakeTextures(model, photographs, options);
  EXPECT_GT(result.model.pages.size(), 1u);
  for (const TexturePage& page : result.model.pages) {
    EXPECT_LE(page.srgb8.width, 256);
    EXPECT_LE(page.srgb8.height, 256);
  }
  EXPECT_NEAR(result.coverage.CoveredShare(), 1, 0.02);
  for (int face = 0; face < 6; ++face) ExpectInPlace(TexelsOf(result.model, face));
}

TEST(BakeTextures, UnfitInputIsNamed) {
  const TemporaryFolder folder;
  PolygonModel model;
  AddWall(model, 0, 10, 0, 10);
  const Camera camera = LookAt({5, -20, 5}, {5, 0, 5}, 64, 48, 60);
  BakePhotograph photograph = PhotographPainted(model, camera, kWaves, folder.path(), "s1");
  photograph.camera.width_px = 128;
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(model, std::vector{photograph}); }),
              testing::HasSubstr("s1.png: is 64x48 px, but its camera is for 128x48"));
  photograph.camera = camera;
  photograph.mask_file = folder.path() / "mask.png";
  WriteLabels(*photograph.mask_file, Image16(32, 48, 1));
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(model, std::vector{photograph}); }),
              testing::HasSubstr("mask.png: mask has 32 x 48 pixels, its photograph 64 x 48"));
  photograph.mask_file.reset();
  photograph.faces_file = folder.path() / "faces.png";
  WriteLabels(*photograph.faces_file, Image16(64, 48, 1, 7));
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(model, std::vector{photograph}); }),
              testing::HasSubstr("faces.png: names face 7, but the model has 1"));
  BakeOptions options;
  options.pages.max_page_texels = 10;
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(model, {}, options); }),
              testing::HasSubstr("max_page_texels"));
}

}  // namespace
}  // namespace groundglass
