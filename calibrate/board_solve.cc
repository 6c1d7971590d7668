// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/board_solve.h"

#include "scene/cholesky.h"
#include "scene/error.h"
#include "scene/least_norm.h"
#include "scene/quantile.h"
#include "scene/symmetric_eigen.h"

#include <ceres/ceres.h>

#include <array>
#include <cmath>

namespace groundglass {
namespace {

// An AprilTag whose whitened residual is this many times the median AprilTag's is bent, misread or
// covered.
constexpr double kOutlierFactor = 6;

// Whitened residual of an AprilTag's four corners, in units of an edge point's noise:
//   r = S (p - o),  S^T S = information,  p_i = project(lens, R X_i + t)
// with project as in scene/camera_model.h and view_tag.h:
//   f_x = W / 2 / tan(v / 2), f_y = f_x a H / W, c = (W / 2 + shift_x W, H / 2 + shift_y W f_y/f_x)
// Blocks: lens 6 (LensVector), rotation 4 (cam_from_board, unit quaternion x y z w), translation 3
// (the board's unit). Residual 8. A corner behind the camera fails the evaluation.
struct AprilTagResidual {
  Eigen::Matrix<double, 2, 4> corners_on_board;
  Eigen::Matrix<double, 8, 1> observed_px;
  Eigen::Matrix<double, 8, 8> root_information;
  double width_px;
  double height_px;

  template <typename T>
  bool Project(const T* lens,
               const T* rotation,
               const T* translation,
               Eigen::Matrix<T, 8, 1>* projected_px) const {
    const Eigen::Matrix<T, 3, 3> cam_from_board =
        Eigen::Map<const Eigen::Quaternion<T>>(rotation).toRotationMatrix();
    using std::tan;
    const T focal_x_px = T(0.5 * width_px) / tan(0.5 * lens[0]);
    const T focal_y_px = focal_x_px * lens[1] * T(height_px / width_px);
    const T center_x_px = T(width_px) * (0.5 + lens[2]);
    const T center_y_px = T(0.5 * height_px) + lens[3] * T(width_px) * focal_y_px / focal_x_px;
    Distortion<T> distortion;
    distortion.k1 = lens[4];
    distortion.k2 = lens[5];
    for (int corner = 0; corner < 4; ++corner) {
      // The board is the plane z = 0.
      std::array<T, 3> in_cam;
      for (int axis = 0; axis < 3; ++axis) {
        in_cam[axis] = cam_from_board(axis, 0) * corners_on_board(0, corner) +
                       cam_from_board(axis, 1) * corners_on_board(1, corner) + translation[axis];
      }
      if (in_cam[2] <= T(0)) return false;
      const Eigen::Matrix<T, 2, 1> distorted =
          Distort<T>(distortion, {in_cam[0] / in_cam[2], in_cam[1] / in_cam[2]});
      (*projected_px)[2 * corner] = focal_x_px * distorted[0] + center_x_px;
      (*projected_px)[2 * corner + 1] = focal_y_px * distorted[1] + center_y_px;
    }
    return true;
  }

  template <typename T>
  bool operator()(const T* lens, const T* rotation, const T* translation, T* residual) const {
    Eigen::Matrix<T, 8, 1> projected_px;
    if (!Project(lens, rotation, translation, &projected_px)) return false;
    // The root is upper triangular, and its numbers need no derivatives.
    for (int row = 0; row < 8; ++row) {
      residual[row] = T(0);
      for (int column = row; column < 8; ++column) {
        residual[row] +=
            root_information(row, column) * (projected_px[column] - observed_px[column]);
      }
    }
    return true;
  }
};

AprilTagResidual MakeResidual(const Board& board,
                              const AprilTagCorners& april_tag,
                              int width_px,
                              int height_px) {
  AprilTagResidual residual;
  residual.corners_on_board = AprilTagCornersOnBoard(board, april_tag.id);
  residual.observed_px = april_tag.corners_px;
  // Corners of which nothing is known say nothing.
  const std::optional<Eigen::MatrixXd> root = UpperCholeskyFactor(april_tag.information);
  residual.root_information.setZero();
  if (root) residual.root_information = *root;
  residual.width_px = width_px;
  residual.height_px = height_px;
  return residual;
}

struct Pose {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d translation;
};

// One AprilTag's residuals as the solution leaves them.
struct AprilTagFit {
  double whitened = 0;    // norm
  double squared_px = 0;  // sum of squares over its 8 coordinates
};

AprilTagFit EvaluateAprilTag(const AprilTagResidual& residual,
                             const LensVector& lens,
                             const Pose& pose) {
  Eigen::Matrix<double, 8, 1> projected_px;
  // The solver only returns poses that it could evaluate.
  residual.Project(
      lens.data(), pose.rotation.coeffs().data(), pose.translation.data(), &projected_px);
  const Eigen::Matrix<double, 8, 1> error_px = projected_px - residual.observed_px;
  return {(residual.root_information * error_px).norm(), error_px.squaredNorm()};
}

// The pose whose plane z = 0 the homography K^-1 H shows (Zhang 2000, section 3.1).
RigidTransform PoseFromHomography(const Eigen::Matrix3d& normalised_homography) {
  Eigen::Matrix3d h = normalised_homography;
  h /= 0.5 * (h.col(0).norm() + h.col(1).norm());
  if (h(2, 2) < 0) h = -h;  // the board is in front
  Eigen::Matrix3d axes;
  axes << h.col(0), h.col(1), h.col(0).cross(h.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  RigidTransform cam_from_board;
  cam_from_board.rotation = svd.matrixU() * svd.matrixV().transpose();
  cam_from_board.translation = h.col(2);
  return cam_from_board;
}

}  // namespace

Eigen::Matrix3d EstimateHomography(const Board& board,
                                   const BoardShot& shot,
                                   const Eigen::Vector2d& center_px,
                                   double scale_px) {
  const double board_scale = board.columns * (board.april_tag_size + board.gap);
  // The normal matrix of the two equations that each corner gives.
  using Vector9 = Eigen::Matrix<double, 9, 1>;
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const AprilTagCorners& april_tag : shot.april_tags) {
    const Eigen::Matrix<double, 2, 4> on_board =
        AprilTagCornersOnBoard(board, april_tag.id) / board_scale;
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d from = on_board.col(corner).homogeneous();
      const Eigen::Vector2d to =
          (april_tag.corners_px.segment<2>(2 * corner) - center_px) / scale_px;
      Vector9 equation;
      equation << from, Eigen::Vector3d::Zero(), -to.x() * from;
      normal += equation * equation.transpose();
      equation << Eigen::Vector3d::Zero(), from, -to.y() * from;
      normal += equation * equation.transpose();
    }
  }
  // Eigenvalues come in increasing order: the first vector fits best.
  const Vector9 h = DecomposeSymmetric(normal).vectors.col(0);
  Eigen::Matrix3d homography;
  homography << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(),
      h.segment<3>(6).transpose();
  homography.topRows<2>() *= scale_px;
  homography.leftCols<2>() /= board_scale;
  return homography;
}

Camera CameraFromLensVector(const LensVector& lens, int width_px, int height_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.focal_x_px = 0.5 * width_px / std::tan(0.5 * lens[0]);
  camera.focal_y_px = camera.focal_x_px * lens[1] * height_px / width_px;
  camera.center_x_px = 0.5 * width_px + lens[2] * width_px;
  camera.center_y_px = 0.5 * height_px + lens[3] * camera.focal_y_px / camera.focal_x_px * width_px;
  camera.k1 = lens[4];
  camera.k2 = lens[5];
  return camera;
}

LensVector EstimateLens(const Board& board,
                        std::vector<BoardShot>& shots,
                        int width_px,
                        int height_px) {
  const Eigen::Vector2d center_px(0.5 * width_px, 0.5 * height_px);
  const double scale_px = 0.5 * width_px;
  std::vector<Eigen::Matrix3d> homographies;
  // With a = 1 / f_x^2, b = 1 / f_y^2 in units of the scale, each homography (h1 h2 h3) gives
  //   h1^T diag(a, b, 1) h2 = 0  and  h1^T diag(a, b, 1) h1 = h2^T diag(a, b, 1) h2.
  Eigen::MatrixX2d left(2 * shots.size(), 2);
  Eigen::VectorXd right(2 * shots.size());
  for (size_t i = 0; i < shots.size(); ++i) {
    homographies.push_back(EstimateHomography(board, shots[i], center_px, scale_px));
    Eigen::Matrix3d h = homographies.back();
    h.topRows<2>() /= scale_px;
    h /= h.leftCols<2>().norm();
    const auto row = static_cast<Eigen::Index>(2 * i);
    left.row(row) << h(0, 0) * h(0, 1), h(1, 0) * h(1, 1);
    right[row] = -h(2, 0) * h(2, 1);
    left.row(row + 1) << h(0, 0) * h(0, 0) - h(0, 1) * h(0, 1),
        h(1, 0) * h(1, 0) - h(1, 1) * h(1, 1);
    right[row + 1] = h(2, 1) * h(2, 1) - h(2, 0) * h(2, 0);
  }
  const Eigen::Vector2d inverse_squares = SolveLeastNorm(left, right);
  double focal_x_px = inverse_squares[0] > 0 ? scale_px / std::sqrt(inverse_squares[0]) : 0;
  double focal_y_px = inverse_squares[1] > 0 ? scale_px / std::sqrt(inverse_squares[1]) : 0;
  // Frontal photographs, or strong distortion, can make nonsense of it: then a normal lens with
  // square pixels, from which the refinement finds its way.
  const double ratio = focal_y_px / focal_x_px;
  if (!(focal_x_px > 0.2 * width_px && focal_x_px < 10 * width_px && ratio > 0.7 && ratio < 1.4)) {
    focal_x_px = focal_y_px = width_px;
  }
  const Eigen::Vector3d inverse_focals(1 / focal_x_px, 1 / focal_y_px, 1);
  for (size_t i = 0; i < shots.size(); ++i) {
    shots[i].cam_from_board = PoseFromHomography(inverse_focals.asDiagonal() * homographies[i]);
  }
  LensVector lens = LensVector::Zero();
  lens[0] = 2 * std::atan(0.5 * width_px / focal_x_px);
  lens[1] = focal_y_px / focal_x_px * width_px / height_px;
  return lens;
}

LensSolution RefineLens(const Board& board,
                        const BoardOptions& options,
                        const LensVector& start,
                        std::vector<BoardShot>& shots,
                        int width_px,
                        int height_px) {
  LensVector lens = start;
  std::vector<Pose> poses;
  for (const BoardShot& shot : shots) {
    poses.push_back(
        {Eigen::Quaterniond(shot.cam_from_board.rotation), shot.cam_from_board.translation});
  }
  LensSolution solution;
  for (int round = 0;; ++round) {
    ceres::Problem problem;
    std::vector<int> fixed;
    if (!options.refine_k2) fixed.push_back(5);
    problem.AddParameterBlock(lens.data(), 6);
    if (!fixed.empty()) problem.SetManifold(lens.data(), new ceres::SubsetManifold(6, fixed));
    for (size_t i = 0; i < shots.size(); ++i) {
      double* rotation = poses[i].rotation.coeffs().data();
      problem.AddParameterBlock(rotation, 4, new ceres::EigenQuaternionManifold);
      for (const AprilTagCorners& april_tag : shots[i].april_tags) {
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<AprilTagResidual, 8, 6, 4, 3>(
                new AprilTagResidual(MakeResidual(board, april_tag, width_px, height_px))),
            nullptr,
            lens.data(),
            rotation,
            poses[i].translation.data());
      }
    }
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.max_num_iterations = 200;
    solver.function_tolerance = 1e-12;
    solver.parameter_tolerance = 1e-12;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (!summary.IsSolutionUsable()) {
      throw Error(
          "calibrate board: the solution did not converge; photograph the board from more "
          "sides, and check its columns, rows, tag size and gap");
    }

    std::vector<double> whitened;
    double squared = 0;
    double squared_px = 0;
    for (size_t i = 0; i < shots.size(); ++i) {
      for (const AprilTagCorners& april_tag : shots[i].april_tags) {
        const AprilTagFit fit =
            EvaluateAprilTag(MakeResidual(board, april_tag, width_px, height_px), lens, poses[i]);
        whitened.push_back(fit.whitened);
        squared += fit.whitened * fit.whitened;
        squared_px += fit.squared_px;
      }
    }
    const double limit = kOutlierFactor * UpperMedian(whitened);
    size_t next = 0;
    size_t removed = 0;
    for (BoardShot& shot : shots) {
      removed += std::erase_if(shot.april_tags,
                               [&](const AprilTagCorners&) { return whitened[next++] > limit; });
    }
    if (removed > 0 && round < 5) {
      for (size_t i = shots.size(); i-- > 0;) {
        if (!shots[i].april_tags.empty()) continue;
        shots.erase(shots.begin() + static_cast<std::ptrdiff_t>(i));
        poses.erase(poses.begin() + static_cast<std::ptrdiff_t>(i));
      }
      continue;
    }

    const double num_residuals = 8.0 * static_cast<double>(whitened.size());
    const double num_unknowns =
        6.0 - static_cast<double>(fixed.size()) + 6.0 * static_cast<double>(shots.size());
    ceres::Covariance::Options covariance_options;
    covariance_options.algorithm_type = ceres::SPARSE_QR;
    ceres::Covariance covariance(covariance_options);
    const std::vector<std::pair<const double*, const double*>> blocks = {
        {lens.data(), lens.data()}};
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> block;
    if (!(num_residuals > num_unknowns) || !covariance.Compute(blocks, &problem) ||
        !covariance.GetCovarianceBlock(lens.data(), lens.data(), block.data())) {
      throw Error(
          "calibrate board: the photographs leave the lens undetermined; turn the board, or "
          "walk around it, by 20 to 45 degrees between photographs");
    }
    solution.lens = lens;
    solution.covariance = block * (squared / (num_residuals - num_unknowns));
    solution.num_corners = 4 * static_cast<int>(whitened.size());
    solution.rms_px = std::sqrt(squared_px / num_residuals);
    for (size_t i = 0; i < shots.size(); ++i) {
      shots[i].cam_from_board = {poses[i].rotation.normalized().toRotationMatrix(),
                                 poses[i].translation};
    }
    return solution;
  }
}

}  // namespace groundglass
