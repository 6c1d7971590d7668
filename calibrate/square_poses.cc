// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/square_poses.h"

#include <opencv2/calib3d.hpp>

namespace groundglass {

std::vector<RigidTransform> FindSquarePoses(const Eigen::Matrix<double, 3, 4>& corners_in_world,
                                            const Eigen::Matrix<double, 8, 1>& corners_px,
                                            const Camera& lens) {
  const Eigen::Matrix<double, 3, 4>& corners = corners_in_world;
  const Eigen::Vector3d right = (corners.col(1) - corners.col(0)).normalized();
  const double half = (corners.col(1) - corners.col(0)).norm() / 2;
  const Eigen::Vector3d out = (corners.col(3) - corners.col(0)).cross(right).normalized();
  RigidTransform world_from_square;
  world_from_square.rotation << right, out.cross(right), out;
  world_from_square.translation = corners.rowwise().mean();
  const std::vector<cv::Point3d> in_square = {
      {-half, half, 0}, {half, half, 0}, {half, -half, 0}, {-half, -half, 0}};
  std::vector<cv::Point2d> in_picture;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector3d ray = UnprojectToCam(lens, corners_px.segment<2>(2 * corner));
    in_picture.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
  }
  std::vector<cv::Mat> turns, translations;
  cv::solvePnPGeneric(in_square,
                      in_picture,
                      cv::Mat::eye(3, 3, CV_64F),
                      cv::noArray(),
                      turns,
                      translations,
                      false,
                      cv::SOLVEPNP_IPPE_SQUARE);
  std::vector<RigidTransform> poses;
  for (size_t i = 0; i < turns.size(); ++i) {
    const Eigen::Vector3d turn(
        turns[i].at<double>(0), turns[i].at<double>(1), turns[i].at<double>(2));
    RigidTransform cam_from_square;
    cam_from_square.rotation =
        turn.norm() > 0 ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                        : Eigen::Matrix3d::Identity();
    cam_from_square.translation = {translations[i].at<double>(0),
                                   translations[i].at<double>(1),
                                   translations[i].at<double>(2)};
    poses.push_back(cam_from_square * Inverse(world_from_square));
  }
  return poses;
}

}  // namespace groundglass
