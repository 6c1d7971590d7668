// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/april_tag_corners.h"
#include "calibrate/april_tag_detection.h"
#include "calibrate/calibrate_board.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"
#include "scene/view_tag.h"
#include "tests/calibrate/board_photographs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include <array>
#include <cmath>
#include <functional>

namespace groundglass {
namespace {

constexpr int kWidthPx = 720;
constexpr int kHeightPx = 480;

ViewTag TrueTag() {
  ViewTag tag;
  tag.view_angle_deg = 52;
  tag.aspect = 1.512;  // the scan's pixels are not quite square
  tag.shift_x = 0.011;
  tag.shift_y = -0.007;
  tag.k1 = -0.12;
  return tag;
}

const BoardStudio& Studio() {
  static const BoardStudio studio(Board{}, CameraFromTag(TrueTag(), kWidthPx, kHeightPx));
  return studio;
}

std::vector<BoardPhotograph> TakePhotographs(int count, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<BoardPhotograph> photographs;
  for (const RigidTransform& pose : Studio().MakePoses(count, random)) {
    photographs.push_back(
        {"photo" + std::to_string(photographs.size()), Studio().Photograph(pose, {}, random)});
  }
  return photographs;
}

// Each number's error in its own standard deviations: view angle, aspect, shift x, shift y, k1.
std::array<double, 5> NormalisedErrors(const Lens& lens) {
  const ViewTag truth = TrueTag();
  return {(lens.view_angle_deg - truth.view_angle_deg) / lens.sigma_view_angle_deg,
          (lens.aspect - truth.aspect) / lens.sigma_aspect,
          (lens.shift_x - truth.shift_x) / lens.sigma_shift_x,
          (lens.shift_y - truth.shift_y) / lens.sigma_shift_y,
          (lens.k1 - truth.k1) / lens.sigma_k1};
}

ImageF Linear(const Image8& srgb_grey) {
  ImageF radiance(srgb_grey.width, srgb_grey.height, 1);
  for (size_t i = 0; i < srgb_grey.values.size(); ++i) {
    radiance.values[i] = LinearFromSrgb(static_cast<float>(srgb_grey.values[i]) / 255.0F);
  }
  return radiance;
}

std::string MessageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Board, CornersGoRoundEachTagFromTheTopLeft) {
  Board board;
  board.columns = 3;
  board.rows = 2;
  board.april_tag_size = 2;
  board.gap = 0.5;
  Eigen::Matrix<double, 2, 4> expected;
  expected << 2.5, 4.5, 4.5, 2.5,  //
      2.5, 2.5, 4.5, 4.5;
  EXPECT_EQ(AprilTagCornersOnBoard(board, 4), expected);
}

TEST(Board, ItsOwnPrintIsDetectedUprightAndWhole) {
  Board board;
  board.columns = 3;
  board.rows = 2;
  board.first_id = 7;
  const Image8 print = DrawBoard(board);
  const std::vector<AprilTagDetection> april_tags = DetectAprilTags(print);
  ASSERT_EQ(april_tags.size(), 6u);
  for (int index = 0; index < 6; ++index) {
    EXPECT_EQ(april_tags[static_cast<size_t>(index)].id, 7 + index);
  }
  // Scale and origin from the first AprilTag's diagonal; every corner must lie where the board
  // says.
  const Eigen::Vector2d origin = april_tags[0].corners_px.col(0);
  const double scale = (april_tags[0].corners_px.col(1) - origin).x();
  for (int index = 0; index < 6; ++index) {
    const Eigen::Matrix<double, 2, 4> expected =
        (scale * AprilTagCornersOnBoard(board, index)).colwise() + origin;
    EXPECT_LT((april_tags[static_cast<size_t>(index)].corners_px - expected).cwiseAbs().maxCoeff(),
              1.5);
  }
}

TEST(Board, ALargePictureOfItShowsTheSameAtLowResolution) {
  const Image8 print = DrawBoard(Board{});
  Image8 large(2 * print.width, 2 * print.height, 1);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) *large.At(x, y) = *print.At(x / 2, y / 2);
  }
  ASSERT_GT(large.width, 3000);  // else both look at the same
  const std::vector<AprilTagDetection> fine = DetectAprilTags(large);
  const std::vector<AprilTagDetection> coarse = DetectAprilTags(large, AprilTagDetail::kCoarse);
  EXPECT_GE(fine.size(), 20u);  // the pictures' own limits: a tag or two slip through either
  EXPECT_GE(coarse.size(), 20u);
  for (const AprilTagDetection& one : fine) {
    for (const AprilTagDetection& other : coarse) {
      if (other.id != one.id) continue;
      EXPECT_LT((other.corners_px - one.corners_px).cwiseAbs().maxCoeff(), 2);
    }
  }
}

TEST(AprilTagCorners, AreGoodToAFewHundredthsOfAPixelAndSaySo) {
  std::mt19937_64 random(3);
  const Camera lens = CameraFromTag(TrueTag(), kWidthPx, kHeightPx);
  double squared_px = 0;
  double chi2 = 0;
  int num_april_tags = 0;
  for (const RigidTransform& pose : Studio().MakePoses(4, random)) {
    const Image8 grey = Studio().Photograph(pose, {}, random);
    const ImageF radiance = Linear(grey);
    for (const AprilTagDetection& detection : DetectAprilTags(grey)) {
      const auto april_tag = MeasureAprilTagCorners(radiance, detection, Board{}.gap, lens);
      if (!april_tag) continue;  // it leaves the frame
      const Eigen::Matrix<double, 2, 4> on_board = AprilTagCornersOnBoard(Board{}, april_tag->id);
      Eigen::Matrix<double, 8, 1> error_px = april_tag->corners_px;
      for (int corner = 0; corner < 4; ++corner) {
        const Eigen::Vector3d in_board(on_board(0, corner), on_board(1, corner), 0);
        error_px.segment<2>(2 * corner) -= *ProjectFromCam(lens, pose * in_board);
      }
      squared_px += error_px.squaredNorm();
      chi2 += error_px.dot(april_tag->information * error_px);
      ++num_april_tags;
    }
  }
  ASSERT_GT(num_april_tags, 80);
  EXPECT_LT(std::sqrt(squared_px / (8 * num_april_tags)), 0.04);
  // The spread of single edge points that the corners' covariances stand for.
  EXPECT_LT(std::sqrt(chi2 / (8 * num_april_tags)), 0.12);
}

TEST(CalibrateBoard, RecoversTheLensWithHonestDeviations) {
  constexpr int kTrials = 10;
  std::array<double, 5> squares{};
  for (uint64_t seed = 1; seed <= kTrials; ++seed) {
    const BoardResult result = CalibrateBoard(TakePhotographs(8, seed), Board{});
    EXPECT_LT(result.rms_px, 0.05);
    EXPECT_LT(std::abs(result.lens.view_angle_deg - 52), 0.1);
    const std::array<double, 5> errors = NormalisedErrors(result.lens);
    for (size_t i = 0; i < errors.size(); ++i) {
      EXPECT_LT(std::abs(errors[i]), 3.5) << "number " << i << ", seed " << seed;
      squares[i] += errors[i] * errors[i] / kTrials;
    }
  }
  // The mean square of a normalised error over ten trials is 1 +- 0.45; its 0.1 % and 99.9 % points
  // are 0.15 and 2.96.
  for (double square : squares) {
    EXPECT_GT(square, 0.15);
    EXPECT_LT(square, 2.96);
  }
}

TEST(CalibrateBoard, AgreesWithOpenCvOnTheSameCorners) {
  const std::vector<BoardPhotograph> photographs = TakePhotographs(8, 21);
  const BoardResult result = CalibrateBoard(photographs, Board{});
  const Camera lens = CameraFromTag(TrueTag(), kWidthPx, kHeightPx);
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> seen_px;
  for (const BoardPhotograph& photograph : photographs) {
    ImageF radiance = Linear(photograph.srgb_grey);
    on_board.emplace_back();
    seen_px.emplace_back();
    for (const AprilTagDetection& detection : DetectAprilTags(photograph.srgb_grey)) {
      const auto april_tag = MeasureAprilTagCorners(radiance, detection, Board{}.gap, lens);
      if (!april_tag) continue;  // it leaves the frame
      const Eigen::Matrix<float, 2, 4> corners =
          AprilTagCornersOnBoard(Board{}, april_tag->id).cast<float>();
      for (int corner = 0; corner < 4; ++corner) {
        on_board.back().emplace_back(corners(0, corner), corners(1, corner), 0.0F);
        // OpenCV's first pixel has its centre at (0, 0).
        seen_px.back().emplace_back(
            static_cast<float>(april_tag->corners_px[2 * corner] - 0.5),
            static_cast<float>(april_tag->corners_px[2 * corner + 1] - 0.5));
      }
    }
  }
  cv::Mat intrinsics;
  cv::Mat distortion;
  cv::Mat rotations;
  cv::Mat translations;
  cv::calibrateCamera(on_board,
                      seen_px,
                      {kWidthPx, kHeightPx},
                      intrinsics,
                      distortion,
                      rotations,
                      translations,
                      cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3);
  const double focal_x_px = intrinsics.at<double>(0, 0);
  const double focal_y_px = intrinsics.at<double>(1, 1);
  const Lens& ours = result.lens;
  const double view_angle_deg = 2 * DegreesFromRadians(std::atan(0.5 * kWidthPx / focal_x_px));
  EXPECT_NEAR(ours.view_angle_deg, view_angle_deg, 3 * ours.sigma_view_angle_deg);
  EXPECT_NEAR(ours.aspect, focal_y_px / focal_x_px * kWidthPx / kHeightPx, 3 * ours.sigma_aspect);
  EXPECT_NEAR(
      ours.shift_x, (intrinsics.at<double>(0, 2) + 0.5) / kWidthPx - 0.5, 3 * ours.sigma_shift_x);
  EXPECT_NEAR(
      ours.shift_y,
      (intrinsics.at<double>(1, 2) + 0.5 - 0.5 * kHeightPx) / kWidthPx * focal_x_px / focal_y_px,
      3 * ours.sigma_shift_y);
  EXPECT_NEAR(ours.k1, distortion.at<double>(0), 3 * ours.sigma_k1);
}

TEST(CalibrateBoard, FindsK2WhenAsked) {
  ViewTag tag = TrueTag();
  tag.view_angle_deg = 75;
  tag.k1 = -0.2;
  tag.k2 = 0.06;
  const BoardStudio studio(Board{}, CameraFromTag(tag, kWidthPx, kHeightPx));
  std::mt19937_64 random(5);
  std::vector<BoardPhotograph> photographs;
  for (const RigidTransform& pose : studio.MakePoses(8, random)) {
    photographs.push_back({"photo", studio.Photograph(pose, {}, random)});
  }
  BoardOptions options;
  options.refine_k2 = true;
  const Lens lens = CalibrateBoard(photographs, Board{}, options).lens;
  EXPECT_GT(lens.sigma_k2, 0);
  EXPECT_LT(lens.sigma_k2, 0.02);
  EXPECT_NEAR(lens.k1, -0.2, 3.5 * lens.sigma_k1);
  EXPECT_NEAR(lens.k2, 0.06, 3.5 * lens.sigma_k2);
  EXPECT_NEAR(lens.view_angle_deg, 75, 3.5 * lens.sigma_view_angle_deg);
}

TEST(CalibrateBoard, LeavesOutAPhotographWithoutTheBoard) {
  std::vector<BoardPhotograph> photographs = TakePhotographs(6, 4);
  photographs.insert(photographs.begin() + 2, {"wall", Image8(kWidthPx, kHeightPx, 1, 128)});
  const BoardResult result = CalibrateBoard(photographs, Board{});
  ASSERT_EQ(result.photographs.size(), 7u);
  EXPECT_EQ(result.photographs[2].name, "wall");
  EXPECT_EQ(result.photographs[2].num_april_tags, 0);
  EXPECT_GE(result.photographs[3].num_april_tags, 20);
  for (double error : NormalisedErrors(result.lens)) EXPECT_LT(std::abs(error), 3.5);
}

TEST(CalibrateBoard, SaysSoWhenTheBoardIsFrontalAndSmall) {
  std::mt19937_64 random(6);
  std::vector<BoardPhotograph> photographs;
  for (int i = 0; i < 4; ++i) {
    RigidTransform pose;
    pose.rotation = Eigen::AngleAxisd(0.08 * (i - 1.5), Eigen::Vector3d::UnitY()).matrix();
    pose.translation = Eigen::Vector3d(-3.6, -2.4, 14);
    photographs.push_back({"frontal", Studio().Photograph(pose, {}, random)});
  }
  const BoardResult result = CalibrateBoard(photographs, Board{});
  EXPECT_THAT(result.remarks, testing::Contains(testing::HasSubstr("the board reaches only")));
  EXPECT_THAT(result.remarks, testing::Contains(testing::HasSubstr("the board is turned by")));
}

TEST(CalibrateBoard, SaysSoWhenTheGapWasMeasuredWrongly) {
  Board wrong_gap;
  wrong_gap.gap = 0.3;
  const BoardResult result = CalibrateBoard(TakePhotographs(4, 7), wrong_gap);
  EXPECT_THAT(result.remarks, testing::Contains(testing::HasSubstr("measure the tag size")));
  EXPECT_GT(result.lens.sigma_view_angle_deg, 0.05);
}

TEST(CalibrateBoard, TheSamePhotographsGiveTheSameBits) {
  const std::vector<BoardPhotograph> photographs = TakePhotographs(4, 8);
  const BoardResult once = CalibrateBoard(photographs, Board{});
  const BoardResult again = CalibrateBoard(photographs, Board{});
  EXPECT_EQ(once.lens.view_angle_deg, again.lens.view_angle_deg);
  EXPECT_EQ(once.lens.sigma_k1, again.lens.sigma_k1);
}

TEST(CalibrateBoard, RefusesWhatMakesNoLens) {
  const std::vector<BoardPhotograph> photographs = TakePhotographs(4, 9);

  std::vector<BoardPhotograph> two(photographs.begin(), photographs.begin() + 2);
  two.push_back({"wall", Image8(kWidthPx, kHeightPx, 1, 128)});
  EXPECT_THAT(MessageOf([&] { CalibrateBoard(two, Board{}); }),
              testing::HasSubstr("2 of 3 photographs show the board with at least 4 of its tags; "
                                 "at least 3 are needed"));

  std::vector<BoardPhotograph> mixed = photographs;
  mixed.push_back({"p9.jpg", Image8(640, 480, 1, 128)});
  EXPECT_THAT(MessageOf([&] { CalibrateBoard(mixed, Board{}); }),
              testing::HasSubstr("p9.jpg: 640 x 480 pixels, but photo0 has 720 x 480"));

  Board other_columns;
  other_columns.columns = 5;
  EXPECT_THAT(MessageOf([&] { CalibrateBoard(photographs, other_columns); }),
              testing::HasSubstr("check columns, rows, tag size and gap"));

  Board no_gap;
  no_gap.gap = 0;
  EXPECT_THAT(MessageOf([&] { CalibrateBoard(photographs, no_gap); }),
              testing::HasSubstr("board: gap must be"));

  BoardOptions strict;
  strict.max_sigma_share = 1e-6;
  EXPECT_THAT(
      MessageOf([&] { CalibrateBoard(photographs, Board{}, strict); }),
      testing::HasSubstr("which is nothing known; photograph the board from several sides"));

  Board too_many;
  too_many.columns = too_many.rows = 30;
  EXPECT_THAT(MessageOf([&] { too_many.Check(); }), testing::HasSubstr("587"));
}

}  // namespace
}  // namespace groundglass
