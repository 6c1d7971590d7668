// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_tags.h"

#include "calibrate/april_tag_corners.h"
#include "calibrate/april_tag_detection.h"
#include "calibrate/seen_tag_cost.h"
#include "calibrate/square_poses.h"
#include "scene/check_option.h"
#include "scene/cholesky.h"
#include "scene/frames.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace groundglass {
namespace {

// Corners of tags too small to be measured are as good as the detector's; pixels.
constexpr double kDetectedCorner_px = 0.5;
// White beside a tag that measuring its edges may count on, as a share of its size: one cell.
constexpr double kWhiteBeside = 0.125;

// (x - mean) / sigma, number by number.
template <int N>
struct NormalPriorCost {
  Eigen::Matrix<double, N, 1> mean, sigmas;
  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    for (int i = 0; i < N; ++i) residuals[i] = (x[i] - mean[i]) / sigmas[i];
    return true;
  }
};

// What the tags' photograph leaves free.
struct TagsState {
  Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
  Eigen::Vector3d world_origin_in_cam = Eigen::Vector3d::Zero();
  TagLens lens = TagLens::Zero();
  std::vector<Eigen::Vector3d> offsets;

  RigidTransform Pose() const { return {cam_from_world.toRotationMatrix(), world_origin_in_cam}; }
};

struct ImageSizePx {
  int width = 0;
  int height = 0;
};

class TagsSolver {
 public:
  TagsSolver(std::vector<SeenTag> seen,
             const ViewTag& lens,
             const ImageSizePx& size,
             const TagsOptions& options)
      : seen_(std::move(seen)), lens_(lens), size_(size), options_(options) {}

  TagsState Start(const RigidTransform& cam_from_world) const {
    TagsState state;
    state.cam_from_world = Eigen::Quaterniond(cam_from_world.rotation);
    state.world_origin_in_cam = cam_from_world.translation;
    state.lens << RadiansFromDegrees(lens_.view_angle_deg), lens_.shift_x, lens_.shift_y, lens_.k1;
    state.offsets.assign(seen_.size(), Eigen::Vector3d::Zero());
    return state;
  }

  // Improves it; returns half the sum of squares, infinite if the start sees a tag behind it.
  double Minimise(TagsState& state) const {
    ceres::Problem problem;
    AddResiduals(problem, state);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary.IsSolutionUsable() ? summary.final_cost : HUGE_VAL;
  }

  Camera CameraOf(const TagsState& state) const {
    ViewTag tag = lens_;
    tag.view_angle_deg = DegreesFromRadians(state.lens[0]);
    tag.shift_x = state.lens[1];
    tag.shift_y = state.lens[2];
    tag.k1 = state.lens[3];
    Camera camera = CameraFromTag(tag, size_.width, size_.height);
    camera.cam_from_world = state.Pose();
    return camera;
  }

  double RmsPx(const TagsState& state) const {
    const Camera camera = CameraOf(state);
    double sum = 0;
    for (const SeenTag& seen : seen_) {
      for (int corner = 0; corner < 4; ++corner) {
        const auto expected = Project(camera, seen.place.corners_in_world.col(corner));
        if (!expected) return HUGE_VAL;
        sum += (*expected - seen.corners_px.segment<2>(2 * corner)).squaredNorm();
      }
    }
    return std::sqrt(sum / (8.0 * static_cast<double>(seen_.size())));
  }

  // The tag with its standard deviations; nothing if they are not determined.
  std::optional<ViewTag> TagOf(const TagsState& state, double cost) const;

 private:
  // Of pose (a turn as Ceres adds it, the translation) and lens.
  static constexpr int kNumFree = 6 + kNumTagLens;
  using Covariance = Eigen::Matrix<double, kNumFree, kNumFree>;

  void AddResiduals(ceres::Problem& problem, TagsState& state) const;
  std::optional<Covariance> FindCovariance(const TagsState& state) const;
  // Position, point on the axis beside the tags, roll and view angle (degrees).
  Eigen::Matrix<double, 8, 1> Numbers(const TagsState& state, double distance) const;

  std::vector<SeenTag> seen_;
  ViewTag lens_;
  ImageSizePx size_;
  TagsOptions options_;
};

void TagsSolver::AddResiduals(ceres::Problem& problem, TagsState& state) const {
  double* const rotation = state.cam_from_world.coeffs().data();
  for (size_t i = 0; i < seen_.size(); ++i) {
    SeenTagCost cost{
        seen_[i], lens_, static_cast<double>(size_.width), static_cast<double>(size_.height)};
    cost.seen.root_information /= options_.edge_noise_px;
    double* const offset = state.offsets[i].data();
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SeenTagCost, 8, 4, 3, kNumTagLens, 3>(
                                 new SeenTagCost(cost)),
                             nullptr,
                             rotation,
                             state.world_origin_in_cam.data(),
                             state.lens.data(),
                             offset);
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<NormalPriorCost<3>, 3, 3>(new NormalPriorCost<3>{
            Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(seen_[i].place.sigma)}),
        nullptr,
        offset);
  }
  const TagSigmas& noted = lens_.sigmas;
  const double shift = noted.shift.value_or(options_.shift);
  NormalPriorCost<kNumTagLens> prior;
  prior.mean << RadiansFromDegrees(lens_.view_angle_deg), lens_.shift_x, lens_.shift_y, lens_.k1;
  prior.sigmas << RadiansFromDegrees(
      noted.view_angle_deg.value_or(options_.view_angle_share * lens_.view_angle_deg)),
      shift, shift, noted.k1.value_or(options_.k1);
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<NormalPriorCost<kNumTagLens>, kNumTagLens, kNumTagLens>(
          new NormalPriorCost<kNumTagLens>(prior)),
      nullptr,
      state.lens.data());
  problem.SetManifold(rotation, new ceres::EigenQuaternionManifold);
}

std::optional<TagsSolver::Covariance> TagsSolver::FindCovariance(const TagsState& found) const {
  TagsState state = found;
  ceres::Problem problem;
  AddResiduals(problem, state);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {
      state.cam_from_world.coeffs().data(), state.world_origin_in_cam.data(), state.lens.data()};
  for (Eigen::Vector3d& offset : state.offsets) options.parameter_blocks.push_back(offset.data());
  ceres::CRSMatrix jacobian;
  if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &jacobian)) return std::nullopt;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(jacobian.num_rows, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    for (int at = jacobian.rows[row]; at < jacobian.rows[row + 1]; ++at) {
      dense(row, jacobian.cols[at]) = jacobian.values[at];
    }
  }
  const std::optional<Eigen::MatrixXd> all = InvertByCholesky(dense.transpose() * dense);
  if (!all) return std::nullopt;
  return Covariance(all->topLeftCorner<kNumFree, kNumFree>());
}

Eigen::Matrix<double, 8, 1> TagsSolver::Numbers(const TagsState& state, double distance) const {
  const Camera camera = CameraOf(state);
  const ViewTag tag = TagFromCamera(camera, distance);
  Eigen::Matrix<double, 8, 1> numbers;
  numbers << tag.position_in_site, tag.lookat_in_site, tag.roll_deg, tag.view_angle_deg;
  return numbers;
}

std::optional<ViewTag> TagsSolver::TagOf(const TagsState& state, double cost) const {
  const std::optional<Covariance> covariance = FindCovariance(state);
  if (!covariance) return std::nullopt;
  const Camera camera = CameraOf(state);
  double distance = 0;
  for (const SeenTag& seen : seen_) {
    distance += (camera.cam_from_world * seen.place.corners_in_world.rowwise().mean()).z();
  }
  distance /= static_cast<double>(seen_.size());
  Eigen::Matrix<double, 8, kNumFree> by_free;
  for (int i = 0; i < kNumFree; ++i) {
    const double step = i < 3 || i >= 6 ? 1e-6 : 1e-6 * distance;
    const auto stepped = [&](double by) {
      TagsState other = state;
      if (i < 3) {
        const Eigen::Vector3d turn = by * Eigen::Vector3d::Unit(i);
        ceres::EigenQuaternionManifold().Plus(state.cam_from_world.coeffs().data(),
                                              turn.data(),
                                              other.cam_from_world.coeffs().data());
      } else if (i < 6) {
        other.world_origin_in_cam[i - 3] += by;
      } else {
        other.lens[i - 6] += by;
      }
      return Numbers(other, distance);
    };
    by_free.col(i) = (stepped(step) - stepped(-step)) / (2 * step);
  }
  // Corners that fit worse than they should widen everything.
  const double degrees_of_freedom = std::max(1.0, 8.0 * static_cast<double>(seen_.size()) - 6);
  const double spread = std::max(1.0, std::sqrt(2 * cost / degrees_of_freedom));
  const Eigen::Matrix<double, 8, 1> sigmas =
      spread * (by_free * *covariance * by_free.transpose()).diagonal().cwiseSqrt();
  ViewTag tag = TagFromCamera(camera, distance);
  tag.camera = lens_.camera;
  tag.sigmas = lens_.sigmas;
  tag.sigmas.position = std::max(sigmas[0], sigmas[1]);
  tag.sigmas.height = sigmas[2];
  tag.sigmas.lookat = sigmas.segment<3>(3).maxCoeff();
  tag.sigmas.roll_deg = sigmas[6];
  tag.sigmas.view_angle_deg = sigmas[7];
  return tag;
}

// The surveyed tags that a photograph shows, with their corners.
std::vector<SeenTag> FindSeenTags(const Image8& srgb_grey,
                                  std::span<const SurveyedTag> surveyed,
                                  const Camera& lens,
                                  const TagsOptions& options) {
  std::vector<SeenTag> seen;
  for (const AprilTagDetection& detection : DetectAprilTags(srgb_grey)) {
    const auto place = std::find_if(surveyed.begin(), surveyed.end(), [&](const SurveyedTag& tag) {
      return tag.id == detection.id;
    });
    if (place == surveyed.end()) continue;
    SeenTag tag;
    tag.place = *place;
    const auto measured = MeasureAprilTagCorners(srgb_grey, detection, kWhiteBeside, lens);
    std::optional<Eigen::MatrixXd> root;
    if (measured) root = UpperCholeskyFactor(measured->information);
    if (root) {
      tag.corners_px = measured->corners_px;
      tag.root_information = *root;
    } else {
      tag.corners_px = Eigen::Map<const Eigen::Matrix<double, 8, 1>>(detection.corners_px.data());
      tag.root_information.setIdentity();
      tag.root_information *= options.edge_noise_px / kDetectedCorner_px;
    }
    seen.push_back(tag);
  }
  return seen;
}

std::vector<SeenTagCorner> CornersOf(const std::vector<SeenTag>& seen, const TagsOptions& options) {
  std::vector<SeenTagCorner> corners;
  for (const SeenTag& tag : seen) {
    const Eigen::Matrix<double, 8, 8> information =
        tag.root_information.transpose() * tag.root_information;
    const Eigen::Matrix<double, 8, 1> variances_px =
        information.inverse().diagonal() * options.edge_noise_px * options.edge_noise_px;
    for (int i = 0; i < 4; ++i) {
      corners.push_back({"",
                         tag.place.id,
                         i,
                         tag.corners_px.segment<2>(2 * i),
                         std::sqrt(variances_px.segment<2>(2 * i).maxCoeff()),
                         tag.place.corners_in_world.col(i),
                         tag.place.sigma});
    }
  }
  return corners;
}

double AreaPx(const SeenTag& seen) {
  const Eigen::Vector2d first = seen.corners_px.segment<2>(4) - seen.corners_px.segment<2>(0);
  const Eigen::Vector2d second = seen.corners_px.segment<2>(6) - seen.corners_px.segment<2>(2);
  return std::abs(first.x() * second.y() - first.y() * second.x()) / 2;
}

struct FoundPose {
  TagsState state;
  double cost = HUGE_VAL;
  bool is_upright = false;
};

// The best of the poses, if it is clearly that or the one that was taken by hand; nothing, and why.
std::optional<FoundPose> ChoosePose(const TagsSolver& solver,
                                    const std::vector<RigidTransform>& starts,
                                    const TagsOptions& options,
                                    std::string& why_not) {
  std::vector<FoundPose> found;
  for (const RigidTransform& start : starts) {
    FoundPose own{solver.Start(start), HUGE_VAL, false};
    own.cost = solver.Minimise(own.state);
    if (!std::isfinite(own.cost)) continue;
    const double roll_deg = TagFromCamera(solver.CameraOf(own.state), 1).roll_deg;
    own.is_upright = std::abs(roll_deg) <= options.most_roll_deg;
    found.push_back(std::move(own));
  }
  std::stable_sort(found.begin(), found.end(), [](const FoundPose& a, const FoundPose& b) {
    return a.cost < b.cost;
  });
  if (found.empty()) {
    why_not = "no pose shows its tags where they are";
    return std::nullopt;
  }
  const bool is_clear = found.size() == 1 || found[1].cost - found[0].cost >= options.clear_cost;
  constexpr double kSamePose = 0.02;  // of the rotations' elements
  if (is_clear ||
      (found[0].state.Pose().rotation - found[1].state.Pose().rotation).norm() < kSamePose) {
    return found[0];
  }
  if (found[0].is_upright == found[1].is_upright) {
    why_not = "its tag is too small or too far to tell which of two ways it faces";
    return std::nullopt;
  }
  return found[0].is_upright ? found[0] : found[1];
}

}  // namespace

void TagsOptions::Check() const {
  CheckAbove(edge_noise_px, 0, "tags options: edge_noise_px");
  CheckAbove(view_angle_share, 0, "tags options: view_angle_share");
  CheckAbove(shift, 0, "tags options: shift");
  CheckAbove(k1, 0, "tags options: k1");
  CheckAbove(max_rms_px, 0, "tags options: max_rms_px");
  CheckAtLeast(clear_cost, 0, "tags options: clear_cost");
  CheckFromTo(most_roll_deg, 0, 180, "tags options: most_roll_deg");
}

TagsResult CalibrateTags(const Image8& srgb_grey,
                         std::span<const SurveyedTag> surveyed,
                         const ViewTag& lens,
                         const TagsOptions& options) {
  options.Check();
  TagsResult result;
  const ImageSizePx size{srgb_grey.width, srgb_grey.height};
  Camera camera = CameraFromTag(lens, size.width, size.height);
  camera.cam_from_world = {};
  std::vector<SeenTag> seen = FindSeenTags(srgb_grey, surveyed, camera, options);
  if (seen.empty()) {
    result.reason = "it shows none of the surveyed tags";
    return result;
  }
  result.corners = CornersOf(seen, options);
  for (const SeenTag& tag : seen) result.ids.push_back(tag.place.id);
  const auto largest = std::max_element(
      seen.begin(), seen.end(), [](const auto& a, const auto& b) { return AreaPx(a) < AreaPx(b); });
  const std::vector<RigidTransform> starts =
      FindSquarePoses(largest->place.corners_in_world, largest->corners_px, camera);
  const TagsSolver solver(std::move(seen), lens, size, options);
  const std::optional<FoundPose> found = ChoosePose(solver, starts, options, result.reason);
  if (!found) return result;
  result.rms_px = solver.RmsPx(found->state);
  if (!(result.rms_px <= options.max_rms_px)) {
    result.reason = "its tags' corners miss their surveyed places by " +
                    std::to_string(static_cast<int>(std::min(result.rms_px, 9999.0))) +
                    " px; check apriltags.csv, and that each number is there once";
    return result;
  }
  const std::optional<ViewTag> tag = solver.TagOf(found->state, found->cost);
  if (!tag) {
    result.reason = "its tags leave the pose undetermined";
    return result;
  }
  result.is_found = true;
  result.tag = *tag;
  return result;
}

}  // namespace groundglass
