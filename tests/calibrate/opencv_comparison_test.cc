// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Boards that are seen in part, blurred or steeply, by `calibrate board` and, from the same
// corners, by OpenCV's calibrateCamera, against the lens that took them.
#include "calibrate/april_tag_corners.h"
#include "calibrate/april_tag_detection.h"
#include "calibrate/calibrate_board.h"
#include "scene/frames.h"
#include "scene/view_tag.h"
#include "tests/calibrate/board_photographs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace groundglass {
namespace {

constexpr int kPictureWidthPx = 720;
constexpr int kPictureHeightPx = 480;
constexpr int kTrials = 3;
constexpr int kPhotographs = 8;
constexpr double kFarOffRms = 6;

ViewTag TrueLens() {
  ViewTag tag;
  tag.view_angle_deg = 52;
  tag.aspect = 1.512;
  tag.shift_x = 0.011;
  tag.shift_y = -0.007;
  tag.k1 = -0.12;
  return tag;
}

struct Situation {
  std::string name;
  double blur_px = 0.7;
  double aside = 0;   // how far the board's middle is off the axis, as a share of the distance
  double nearer = 1;  // the distance's factor
  double more_tilt_deg = 0;
  // How far off ours may be, in its own standard deviations.
  double most_sigmas = 4;
  double most_mean_square = 2.5;
};

// View angle (degrees), aspect, shift x and y, k1.
using Numbers = std::array<double, 5>;

Numbers NumbersOf(const ViewTag& lens) {
  return {lens.view_angle_deg, lens.aspect, lens.shift_x, lens.shift_y, lens.k1};
}

std::vector<BoardPhotograph> TakeThem(const Situation& situation, uint64_t seed) {
  static const BoardStudio studio(Board{},
                                  CameraFromTag(TrueLens(), kPictureWidthPx, kPictureHeightPx));
  std::mt19937_64 random(seed);
  std::vector<BoardPhotograph> photographs;
  const Board board;
  const double pitch = board.april_tag_size + board.gap;
  const Eigen::Vector3d middle(0.5 * board.columns * pitch, 0.5 * board.rows * pitch, 0);
  int number = 0;
  for (RigidTransform pose : studio.MakePoses(kPhotographs, random)) {
    const Eigen::Vector3d at = pose * middle;
    // Tilted further about the axis about which it is tilted already.
    const Eigen::Vector3d facing = pose.rotation.col(2);
    const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ().cross(facing).normalized();
    pose.rotation =
        Eigen::AngleAxisd(RadiansFromDegrees(situation.more_tilt_deg), axis) * pose.rotation;
    const double angle = 2.4 * number++;
    const Eigen::Vector3d aside(std::cos(angle), 0.6 * std::sin(angle), 0);
    const Eigen::Vector3d moved = situation.nearer * (at + situation.aside * at.z() * aside);
    pose.translation = moved - pose.rotation * middle;
    photographs.push_back({"photo" + std::to_string(number),
                           studio.Photograph(pose, {situation.blur_px, 2, true}, random)});
  }
  return photographs;
}

struct OpenCvLens {
  Numbers numbers;
  Numbers sigmas;
  double rms_px = 0;  // each axis apart
};

// OpenCV's, of the corners that are measured through the lens that was found.
OpenCvLens CalibrateWithOpenCv(const std::vector<BoardPhotograph>& photographs,
                               const BoardResult& ours) {
  const Lens& found = ours.lens;
  ViewTag tag;
  tag.view_angle_deg = found.view_angle_deg;
  tag.aspect = found.aspect;
  tag.shift_x = found.shift_x;
  tag.shift_y = found.shift_y;
  tag.k1 = found.k1;
  const Camera lens = CameraFromTag(tag, kPictureWidthPx, kPictureHeightPx);
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> seen_px;
  for (size_t i = 0; i < photographs.size(); ++i) {
    const BoardPhotograph& photograph = photographs[i];
    const RigidTransform& cam_from_board = ours.photographs[i].cam_from_board;
    std::vector<cv::Point3f> places;
    std::vector<cv::Point2f> seen;
    for (AprilTagDetection detection : DetectAprilTags(photograph.srgb_grey)) {
      const Eigen::Matrix<double, 2, 4> on_the_board =
          AprilTagCornersOnBoard(Board{}, detection.id);
      // Measured from where the solution expects them, as `calibrate board` does at last.
      for (int corner = 0; corner < 4; ++corner) {
        const auto expected = ProjectFromCam(
            lens,
            cam_from_board * Eigen::Vector3d(on_the_board(0, corner), on_the_board(1, corner), 0));
        if (expected) detection.corners_px.col(corner) = *expected;
      }
      const auto april_tag =
          MeasureAprilTagCorners(photograph.srgb_grey, detection, Board{}.gap, lens);
      if (!april_tag) continue;
      // It has no robust loss: tags that `calibrate board` leaves out are kept from it too.
      const Eigen::Map<const Eigen::Matrix<double, 8, 1>> expected_px(detection.corners_px.data());
      if ((april_tag->corners_px - expected_px).cwiseAbs().maxCoeff() > kFarOffRms * ours.rms_px) {
        continue;
      }
      const Eigen::Matrix<float, 2, 4> corners = on_the_board.cast<float>();
      for (int corner = 0; corner < 4; ++corner) {
        places.emplace_back(corners(0, corner), corners(1, corner), 0.0F);
        // OpenCV's first pixel has its centre at (0, 0).
        seen.emplace_back(static_cast<float>(april_tag->corners_px[2 * corner] - 0.5),
                          static_cast<float>(april_tag->corners_px[2 * corner + 1] - 0.5));
      }
    }
    if (places.size() < 16) continue;
    on_board.push_back(places);
    seen_px.push_back(seen);
  }
  cv::Mat intrinsics, distortion, rotations, translations, sigmas, pose_sigmas, errors;
  const double rms =
      cv::calibrateCamera(on_board,
                          seen_px,
                          {kPictureWidthPx, kPictureHeightPx},
                          intrinsics,
                          distortion,
                          rotations,
                          translations,
                          sigmas,
                          pose_sigmas,
                          errors,
                          cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3);
  const double focal_x = intrinsics.at<double>(0, 0);
  const double focal_y = intrinsics.at<double>(1, 1);
  OpenCvLens result;
  result.numbers = {2 * DegreesFromRadians(std::atan(0.5 * kPictureWidthPx / focal_x)),
                    focal_y / focal_x * kPictureWidthPx / kPictureHeightPx,
                    (intrinsics.at<double>(0, 2) + 0.5) / kPictureWidthPx - 0.5,
                    (intrinsics.at<double>(1, 2) + 0.5 - 0.5 * kPictureHeightPx) / kPictureWidthPx *
                        focal_x / focal_y,
                    distortion.at<double>(0)};
  const double tangent = 0.5 * kPictureWidthPx / focal_x;
  const double by_focal = 2 * tangent / (1 + tangent * tangent) / focal_x;
  result.sigmas = {DegreesFromRadians(by_focal * sigmas.at<double>(0)),
                   0,  // it does not say how the two focal lengths err together
                   sigmas.at<double>(2) / kPictureWidthPx,
                   sigmas.at<double>(3) / kPictureWidthPx,
                   sigmas.at<double>(4)};
  result.rms_px = rms / std::sqrt(2.0);
  return result;
}

class OpenCvComparison : public testing::TestWithParam<Situation> {};

TEST_P(OpenCvComparison, OursIsWithinItsDeviationsAndNearTheirs) {
  const Numbers truth = NumbersOf(TrueLens());
  double ours_squared = 0;    // in our standard deviations
  double theirs_squared = 0;  // in the same ones
  double apart = 0;           // the farthest that the two are from one another, in joint sigmas
  double ours_rms = 0;
  double theirs_rms = 0;
  double worst_view_angle[2] = {0, 0};
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<BoardPhotograph> photographs =
        TakeThem(GetParam(), 100 + static_cast<uint64_t>(trial));
    const BoardResult result = CalibrateBoard(photographs, Board{});
    const Lens& lens = result.lens;
    const OpenCvLens other = CalibrateWithOpenCv(photographs, result);
    const Numbers ours = {lens.view_angle_deg, lens.aspect, lens.shift_x, lens.shift_y, lens.k1};
    const Numbers sigmas = {lens.sigma_view_angle_deg,
                            lens.sigma_aspect,
                            lens.sigma_shift_x,
                            lens.sigma_shift_y,
                            lens.sigma_k1};
    for (size_t i = 0; i < ours.size(); ++i) {
      EXPECT_LT(std::abs(ours[i] - truth[i]), GetParam().most_sigmas * sigmas[i]) << "number " << i;
      ours_squared += std::pow((ours[i] - truth[i]) / sigmas[i], 2) / (5 * kTrials);
      theirs_squared += std::pow((other.numbers[i] - truth[i]) / sigmas[i], 2) / (5 * kTrials);
      apart = std::max(
          apart, std::abs(ours[i] - other.numbers[i]) / std::hypot(sigmas[i], other.sigmas[i]));
    }
    ours_rms += result.rms_px / kTrials;
    theirs_rms += other.rms_px / kTrials;
    worst_view_angle[0] = std::max(worst_view_angle[0], std::abs(ours[0] - truth[0]));
    worst_view_angle[1] = std::max(worst_view_angle[1], std::abs(other.numbers[0] - truth[0]));
  }
  EXPECT_LT(apart, 3);
  EXPECT_LT(ours_squared, 1.3 * theirs_squared + 0.3);
  EXPECT_LT(ours_squared, GetParam().most_mean_square);
  RecordProperty("ours_mean_square", std::to_string(ours_squared));
  RecordProperty("opencv_mean_square_in_our_sigmas", std::to_string(theirs_squared));
  RecordProperty("apart_in_joint_sigmas", std::to_string(apart));
  RecordProperty("ours_rms_px", std::to_string(ours_rms));
  RecordProperty("opencv_rms_px", std::to_string(theirs_rms));
  RecordProperty("ours_view_angle_off_deg", std::to_string(worst_view_angle[0]));
  RecordProperty("opencv_view_angle_off_deg", std::to_string(worst_view_angle[1]));
}

INSTANTIATE_TEST_SUITE_P(Boards,
                         OpenCvComparison,
                         testing::Values(Situation{"Whole"},
                                         Situation{"InPart", 0.7, 0.22, 0.85},
                                         Situation{"Blurred", 1.6, 0, 1, 0, 5, 4},
                                         Situation{"Steep", 0.7, 0, 1, 28, 5, 4}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace groundglass
