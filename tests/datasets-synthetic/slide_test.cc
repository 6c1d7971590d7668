// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/slide.h"

#include "scene/formats/image_io.h"
#include "scene/srgb.h"
#include "scene/view_tag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

ViewTag MakeTag() {
  ViewTag tag;
  tag.position_in_site = {232, -104, 4.5};
  tag.lookat_in_site = {104, -2, 33.1};
  tag.roll_deg = 0.4;
  return tag;
}

const SlideTransform kSlide{12.5, -7.25, 1.3, 1.012, -0.004};

TEST(FoldInSlide, ProjectsToWhereTheSlideMovesTheIdealPicture) {
  for (const double k1 : {0.0, -0.05}) {
    ViewTag tag = MakeTag();
    tag.k1 = k1;
    const Camera ideal = CameraFromTag(tag, 1500, 1000);
    const Camera folded = FoldInSlide(ideal, kSlide);
    for (const Eigen::Vector3d& point : {Eigen::Vector3d(104, 30, 66),
                                         Eigen::Vector3d(49, 40, 0),
                                         Eigen::Vector3d(90, -100, 14)}) {
      const Eigen::Vector2d expected = kSlide.ScanFromIdeal(*Project(ideal, point), 1500, 1000);
      EXPECT_LT((*Project(folded, point) - expected).norm(), 1e-9);
    }
  }
}

TEST(FoldInSlide, IsWhatTheFormatsPageSaysOfTheTag) {
  const Camera folded = FoldInSlide(CameraFromTag(MakeTag(), 1500, 1000), kSlide);
  const ViewTag tag = TagFromCamera(folded, 100);
  EXPECT_NEAR(tag.roll_deg, 0.4 - 1.3, 1e-9);  // a clockwise slide lowers the tag's roll
  EXPECT_NEAR(tag.shift_x, 12.5 / 1500, 1e-12);
  EXPECT_NEAR((tag.position_in_site - MakeTag().position_in_site).norm(), 0, 1e-9);
}

TEST(SlideTransform, TurnsClockwiseOnTheScreen) {
  SlideTransform slide;
  slide.turn_deg = 90;
  const Eigen::Vector2d right_of_center(760, 500);
  EXPECT_LT((slide.ScanFromIdeal(right_of_center, 1500, 1000) - Eigen::Vector2d(750, 510)).norm(),
            1e-9);
}

TEST(DevelopPhotograph, GrainHasTheDeviationAskedForAndNoBias) {
  const ImageF grey(200, 200, 3, 0.2140411f);  // encodes to 0.5
  Photometry photometry;
  photometry.grain = 0.02;
  const Camera camera = CameraFromTag(MakeTag(), 200, 200);
  const Image8 picture = QuantiseSrgb8(DevelopPhotograph(grey, camera, photometry, 5));
  double sum = 0;
  double squares = 0;
  for (const uint8_t value : picture.values) {
    sum += value;
    squares += value * value;
  }
  const double count = static_cast<double>(picture.values.size());
  const double mean = sum / count;
  EXPECT_NEAR(mean, 127.5, 0.3);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.02 * 255, 0.3);
}

TEST(DevelopPhotograph, OneStopDoublesTheLight) {
  const ImageF grey(8, 8, 3, 0.1f);
  Photometry photometry;
  photometry.exposure_stops = 1;
  const Camera camera = CameraFromTag(MakeTag(), 8, 8);
  const ImageF brighter = DevelopPhotograph(grey, camera, photometry, 5);
  const ImageF expected = DevelopPhotograph(ImageF(8, 8, 3, 0.2f), camera, Photometry(), 5);
  EXPECT_EQ(brighter.values, expected.values);
}

// What a spoilt photograph does to a thin bright line across the middle of the picture: its light
// stays, where it was on average, spread as far as asked for.
struct Spread {
  double light = 0;
  double middle_px = 0;
  double deviation_px = 0;
};
Spread SpreadOfUprightLine(const Photometry& photometry) {
  ImageF radiance(61, 41, 3);
  for (int y = 0; y < 41; ++y) *radiance.At(30, y) = 0.5f;
  const Camera camera = CameraFromTag(MakeTag(), 61, 41);
  const ImageF picture = DevelopPhotograph(radiance, camera, photometry, 1);
  Spread spread;
  double squares = 0;
  for (int x = 0; x < 61; ++x) {
    const double light = LinearFromSrgb(*picture.At(x, 20));
    spread.light += light;
    spread.middle_px += light * (x + 0.5);
    squares += light * (x + 0.5) * (x + 0.5);
  }
  spread.middle_px /= spread.light;
  spread.deviation_px = std::sqrt(squares / spread.light - spread.middle_px * spread.middle_px);
  return spread;
}

TEST(DevelopPhotograph, MotionSpreadsALineAlongItselfAndMovesNothing) {
  Photometry across;
  across.motion_px = 12;
  const Spread wide = SpreadOfUprightLine(across);
  EXPECT_NEAR(wide.light, 0.5, 0.005);
  EXPECT_NEAR(wide.middle_px, 30.5, 0.02);
  EXPECT_NEAR(wide.deviation_px, 12 / std::sqrt(12.0), 0.1);  // an even spread over 12 px
  Photometry along = across;
  along.motion_deg = 90;
  EXPECT_LT(SpreadOfUprightLine(along).deviation_px, 0.4);
}

TEST(DevelopPhotograph, DefocusSpreadsOverADiscOfTheRadiusAskedFor) {
  Photometry photometry;
  photometry.defocus_px = 6;
  const Spread spread = SpreadOfUprightLine(photometry);
  EXPECT_NEAR(spread.light, 0.5, 0.005);
  EXPECT_NEAR(spread.middle_px, 30.5, 0.02);
  EXPECT_NEAR(spread.deviation_px, 3, 0.1);  // of one coordinate of a disc: half its radius
}

}  // namespace
}  // namespace groundglass
