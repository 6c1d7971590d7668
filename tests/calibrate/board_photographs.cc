// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/calibrate/board_photographs.h"

#include "calibrate/april_tag_detection.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr int kSamplesAcross = 4;  // rays a pixel, each way
constexpr float kWhite = 0.75F;    // of full scale, linear light
constexpr float kBlack = 0.03F;
constexpr float kWall = 0.35F;  // what is behind the board

}  // namespace

BoardStudio::BoardStudio(const Board& board, const Camera& lens)
    : board_(board),
      lens_(lens),
      cells_(kAprilTagCells * board.columns, kAprilTagCells * board.rows, 1) {
  for (int index = 0; index < board.columns * board.rows; ++index) {
    const AprilTagPattern is_white = GetAprilTagPattern(board.first_id + index);
    for (int row = 0; row < kAprilTagCells; ++row) {
      for (int column = 0; column < kAprilTagCells; ++column) {
        *cells_.At(index % board.columns * kAprilTagCells + column,
                   index / board.columns * kAprilTagCells + row) = is_white(row, column) ? 255 : 0;
      }
    }
  }
  for (int y = 0; y < lens.height_px * kSamplesAcross; ++y) {
    for (int x = 0; x < lens.width_px * kSamplesAcross; ++x) {
      const Eigen::Vector3d ray =
          UnprojectToCam(lens, {(x + 0.5) / kSamplesAcross, (y + 0.5) / kSamplesAcross});
      rays_.push_back(ray.head<2>().cast<float>());
    }
  }
}

bool BoardStudio::IsWhite(double x, double y) const {
  const double pitch = board_.april_tag_size + board_.gap;
  const double column = std::floor(x / pitch);
  const double row = std::floor(y / pitch);
  const double u = (x - column * pitch) / board_.april_tag_size * kAprilTagCells;
  const double v = (y - row * pitch) / board_.april_tag_size * kAprilTagCells;
  if (column < 0 || row < 0 || column >= board_.columns || row >= board_.rows) return true;
  if (u >= kAprilTagCells || v >= kAprilTagCells) return true;
  return *cells_.At(static_cast<int>(column) * kAprilTagCells + static_cast<int>(u),
                    static_cast<int>(row) * kAprilTagCells + static_cast<int>(v)) != 0;
}

Image8 BoardStudio::Photograph(const RigidTransform& cam_from_board,
                               const Look& look,
                               std::mt19937_64& random) const {
  const double pitch = board_.april_tag_size + board_.gap;
  const Eigen::Vector2d end(board_.columns * pitch, board_.rows * pitch);
  // Where a ray meets the plane z = 0, homogeneous: the inverse of (r1 r2 t).
  Eigen::Matrix3d board_to_ray;
  board_to_ray << cam_from_board.rotation.leftCols<2>(), cam_from_board.translation;
  const Eigen::Matrix3d board_from_ray = board_to_ray.inverse();

  cv::Mat radiance(lens_.height_px, lens_.width_px, CV_32FC1, cv::Scalar(0));
  const int samples_wide = lens_.width_px * kSamplesAcross;
  for (size_t i = 0; i < rays_.size(); ++i) {
    const Eigen::Vector3d ray(rays_[i].x(), rays_[i].y(), 1);
    const Eigen::Vector2d at = (board_from_ray * ray).hnormalized();
    float value = kWall;
    if (at.x() > -board_.gap && at.y() > -board_.gap && at.x() < end.x() && at.y() < end.y()) {
      value = IsWhite(at.x(), at.y()) ? kWhite : kBlack;
    }
    const int x = static_cast<int>(i) % samples_wide / kSamplesAcross;
    const int y = static_cast<int>(i) / samples_wide / kSamplesAcross;
    radiance.at<float>(y, x) += value / (kSamplesAcross * kSamplesAcross);
  }
  cv::GaussianBlur(radiance, radiance, {}, look.blur_px);

  Image8 srgb_grey(lens_.width_px, lens_.height_px, 1);
  std::normal_distribution<double> noise(0, look.noise);
  for (int y = 0; y < lens_.height_px; ++y) {
    for (int x = 0; x < lens_.width_px; ++x) {
      const double light =
          look.uneven_light ? 0.6 + 0.4 * x / lens_.width_px + 0.2 * y / lens_.height_px : 1.0;
      const double encoded =
          255.0 * SrgbFromLinear(static_cast<float>(light) * radiance.at<float>(y, x));
      *srgb_grey.At(x, y) =
          static_cast<uint8_t>(std::clamp(std::lround(encoded + noise(random)), 0L, 255L));
    }
  }
  return srgb_grey;
}

std::vector<RigidTransform> BoardStudio::MakePoses(int count, std::mt19937_64& random) const {
  const double pitch = board_.april_tag_size + board_.gap;
  const Eigen::Vector3d middle(
      0.5 * (board_.columns * pitch - board_.gap), 0.5 * (board_.rows * pitch - board_.gap), 0);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<RigidTransform> poses;
  for (int i = 0; i < count; ++i) {
    // Turned by 15 to 40 degrees about an axis in the board, each photograph's further round.
    const double axis_rad = 2 * M_PI * (i + 0.3 * uniform(random)) / count;
    const double tilt_rad = RadiansFromDegrees(27.5 + 12.5 * uniform(random));
    const double spin_rad = RadiansFromDegrees(10 * uniform(random));
    RigidTransform pose;
    pose.rotation =
        (Eigen::AngleAxisd(spin_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d(std::cos(axis_rad), std::sin(axis_rad), 0)))
            .toRotationMatrix();
    // The board fills most of the frame's width.
    const double distance =
        (1.15 + 0.1 * uniform(random)) * board_.columns * pitch * lens_.focal_x_px / lens_.width_px;
    const Eigen::Vector3d aim(
        0.06 * distance * uniform(random), 0.06 * distance * uniform(random), distance);
    pose.translation = aim - pose.rotation * middle;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace groundglass
