// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/foreign_lens.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

using testing::HasSubstr;

class ForeignLens : public TemporaryFolder, public testing::Test {
 protected:
  Lens Read(const std::string& text) { return ReadLens(Write("lens", text)); }
};

// A camera of 640 x 480 with f_x 500, f_y 510 and its centre at (330, 235), corners counted from 0.
void ExpectTheCamera(const Lens& lens) {
  EXPECT_NEAR(lens.view_angle_deg, 2 * std::atan(320.0 / 500) * 180 / M_PI, 1e-9);
  EXPECT_NEAR(lens.aspect, 640.0 / 480 * 510 / 500, 1e-12);
  EXPECT_NEAR(lens.shift_x, 10.0 / 640, 1e-12);
  EXPECT_NEAR(lens.shift_y, -5.0 / 640 * 500 / 510, 1e-12);
  EXPECT_EQ(lens.k1, -0.1);
  EXPECT_EQ(lens.k2, 0.02);
  EXPECT_EQ(lens.p1, 0.001);
  EXPECT_EQ(lens.p2, -0.002);
}

TEST_F(ForeignLens, ColmapsCameraIsRead) {
  ExpectTheCamera(Read("# Camera list\n1 OPENCV 640 480 500 510 330 235 -0.1 0.02 0.001 -0.002\n"));
}

TEST_F(ForeignLens, OpenCvsMatrixIsReadWithItsPixelCentres) {
  ExpectTheCamera(
      Read("%YAML:1.0\n---\ncalibration_time: \"today\"\nimage_width: 640\nimage_height: 480\n"
           "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
           "   data: [ 500., 0., 329.5, 0., 510., 234.5,\n       0., 0., 1. ]\n"
           "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
           "   data: [ -0.1, 0.02, 0.001, -0.002, 0. ]\n"));
}

TEST_F(ForeignLens, RosCameraInfoIsRead) {
  ExpectTheCamera(
      Read("image_width: 640\nimage_height: 480\ncamera_name: head\ncamera_matrix:\n  rows: 3\n"
           "  cols: 3\n  data: [500, 0, 329.5, 0, 510, 234.5, 0, 0, 1]\n"
           "distortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n"
           "  data: [-0.1, 0.02, 0.001, -0.002, 0]\n"));
}

TEST_F(ForeignLens, KalibrsChainOfOneIsRead) {
  ExpectTheCamera(
      Read("cam0:\n  camera_model: pinhole\n  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]\n"
           "  distortion_model: radtan\n  intrinsics: [500.0, 510.0, 329.5, 234.5]\n"
           "  resolution: [640, 480]\n  rostopic: /cam0/image_raw\n"));
}

TEST_F(ForeignLens, WhatIsWrittenReadsBackAsTheSameLens) {
  Lens lens;
  lens.view_angle_deg = 57.3;
  lens.aspect = 1.49;
  lens.shift_x = 0.011;
  lens.shift_y = -0.004;
  lens.k1 = -0.12;
  lens.k2 = 0.03;
  lens.p1 = 0.0007;
  for (const LensFormat format :
       {LensFormat::kColmap, LensFormat::kOpenCv, LensFormat::kRos, LensFormat::kKalibr}) {
    const Lens read = Read(FormatForeignLens(lens, format, 1500, 1000));
    EXPECT_NEAR(read.view_angle_deg, lens.view_angle_deg, 1e-9);
    EXPECT_NEAR(read.aspect, lens.aspect, 1e-12);
    EXPECT_NEAR(read.shift_x, lens.shift_x, 1e-12);
    EXPECT_NEAR(read.shift_y, lens.shift_y, 1e-12);
    EXPECT_EQ(read.k1, lens.k1);
    EXPECT_EQ(read.k2, lens.k2);
    EXPECT_EQ(read.p1, lens.p1);
  }
}

TEST_F(ForeignLens, WhatCannotBeMeantIsNamed) {
  const auto message = [&](const std::string& text) { return ThrownMessage([&] { Read(text); }); };
  EXPECT_THAT(message("1 OPENCV_FISHEYE 640 480 500 510 330 235 0 0 0 0\n"),
              HasSubstr("lens:1: camera model 'OPENCV_FISHEYE' is not known here"));
  EXPECT_THAT(message("1 PINHOLE 640 480 500 510 330 235\n2 PINHOLE 640 480 500 510 330 235\n"),
              HasSubstr("several cameras"));
  EXPECT_THAT(message("camera_matrix:\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"),
              HasSubstr("image_width and image_height are missing"));
  EXPECT_THAT(message("cam0:\n  distortion_model: equidistant\n  intrinsics: [1, 1, 1, 1]\n"
                      "  resolution: [2, 2]\n"),
              HasSubstr("equidistant is not known"));
  EXPECT_THAT(message("cam0:\n  intrinsics: [0, 1, 1, 1]\n  resolution: [2, 2]\n"),
              HasSubstr("must be above 0"));
  Lens lens;
  lens.view_angle_deg = 50;
  lens.aspect = 1.5;
  lens.k3 = 0.1;
  EXPECT_THAT(ThrownMessage([&] { FormatForeignLens(lens, LensFormat::kColmap, 30, 20); }),
              HasSubstr("no place for the lens' k3"));
}

TEST_F(ForeignLens, APictureInItsPlaceIsNamedAndNotPrinted) {
  const std::string jpeg = std::string("\xFF\xD8\xFF\xE0\0\x10JFIF\0", 11);
  const std::string message = ThrownMessage([&] { Read(jpeg); });
  EXPECT_THAT(message, HasSubstr("lens: a picture, and no lens file; expected"));
  EXPECT_EQ(message.find('\xFF'), std::string::npos);
}

}  // namespace
}  // namespace groundglass
