// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/camera_path.h"

#include "scene/building_bounds.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace groundglass {
namespace {

// A camera as numbers that may be interpolated, its rotation apart. On the way around a model the
// position is given by bearing, distance and height from the model's upright axis, and the rotation
// relative to the bearing: then a steady pose is a camera that circles the model and faces it.
struct Pose {
  // Position (world, or bearing, distance, height), focal lengths, principal point, k1 k2 k3 p1 p2.
  Eigen::Matrix<double, 12, 1> numbers = Eigen::Matrix<double, 12, 1>::Zero();
  Eigen::Quaterniond frame_from_cam = Eigen::Quaterniond::Identity();
};

// What poses are given in: world, or turning with the bearing around an upright axis.
struct PoseFrame {
  bool is_around = false;
  Eigen::Vector3d axis_in_world = Eigen::Vector3d::Zero();  // a point of it
};

Eigen::Quaterniond TurnByBearing(double bearing) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(bearing, Eigen::Vector3d::UnitZ()));
}

Pose PoseOf(const Camera& camera, const PoseFrame& frame) {
  Pose pose;
  Eigen::Vector3d position = camera.PositionInWorld();
  pose.frame_from_cam = Eigen::Quaterniond(camera.cam_from_world.rotation.transpose());
  if (frame.is_around) {
    const Eigen::Vector3d out = position - frame.axis_in_world;
    const double bearing = std::atan2(out.y(), out.x());
    position = {bearing, out.head<2>().norm(), position.z()};
    pose.frame_from_cam = TurnByBearing(-bearing) * pose.frame_from_cam;
  }
  pose.numbers << position, camera.focal_x_px, camera.focal_y_px, camera.center_x_px,
      camera.center_y_px, camera.k1, camera.k2, camera.k3, camera.p1, camera.p2;
  return pose;
}

Camera CameraOf(const Pose& pose, const PoseFrame& frame, const Camera& like) {
  Eigen::Vector3d position = pose.numbers.head<3>();
  Eigen::Quaterniond world_from_cam = pose.frame_from_cam.normalized();
  if (frame.is_around) {
    const double bearing = position[0];
    world_from_cam = TurnByBearing(bearing) * world_from_cam;
    position = {frame.axis_in_world.x() + position[1] * std::cos(bearing),
                frame.axis_in_world.y() + position[1] * std::sin(bearing),
                position[2]};
  }
  Camera camera = like;
  camera.focal_x_px = pose.numbers[3];
  camera.focal_y_px = pose.numbers[4];
  camera.center_x_px = pose.numbers[5];
  camera.center_y_px = pose.numbers[6];
  camera.k1 = pose.numbers[7];
  camera.k2 = pose.numbers[8];
  camera.k3 = pose.numbers[9];
  camera.p1 = pose.numbers[10];
  camera.p2 = pose.numbers[11];
  camera.cam_from_world.rotation = world_from_cam.toRotationMatrix().transpose();
  camera.cam_from_world.translation = -(camera.cam_from_world.rotation * position);
  return camera;
}

PoseFrame ChoosePoseFrame(const PolygonModel& model, const std::vector<Camera>& cameras) {
  const Box bounds = ComputeBounds(model);
  const Eigen::AlignedBox3d box(bounds.min, bounds.max);
  PoseFrame frame;
  frame.axis_in_world = bounds.Center();
  frame.is_around = std::none_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
    return box.contains(camera.PositionInWorld());
  });
  return frame;
}

// The pose at time t on the straight way from a (at t_a) to b (at t_b); outside them, beyond.
Pose Blend(const Pose& a, const Pose& b, double t_a, double t_b, double t) {
  const double share = (t - t_a) / (t_b - t_a);
  return {(1 - share) * a.numbers + share * b.numbers,
          a.frame_from_cam.slerp(share, b.frame_from_cam)};
}

// Barry and Goldman's pyramid for the Catmull-Rom curve between knots 1 and 2 of four.
Pose CatmullRom(const std::array<Pose, 4>& poses, const std::array<double, 4>& knots, double t) {
  const Pose a = Blend(poses[0], poses[1], knots[0], knots[1], t);
  const Pose b = Blend(poses[1], poses[2], knots[1], knots[2], t);
  const Pose c = Blend(poses[2], poses[3], knots[2], knots[3], t);
  const Pose d = Blend(a, b, knots[0], knots[2], t);
  const Pose e = Blend(b, c, knots[1], knots[3], t);
  return Blend(d, e, knots[1], knots[2], t);
}

// How far apart two cameras look: ways and turns do not compare, so the way is counted in sizes of
// the whole path and the turn in half circles.
double Separation(const Camera& a, const Camera& b, double path_size) {
  const double way = (a.PositionInWorld() - b.PositionInWorld()).norm();
  const Eigen::Matrix3d turn = a.cam_from_world.rotation * b.cam_from_world.rotation.transpose();
  return way / path_size + Eigen::AngleAxisd(turn).angle() / M_PI;
}

// A smooth curve through cameras.
class Curve {
 public:
  Curve(const std::vector<Camera>& cameras, const PoseFrame& frame)
      : frame_(frame), like_(cameras.front()) {
    Eigen::AlignedBox3d box;
    for (const Camera& camera : cameras) box.extend(camera.PositionInWorld());
    path_size_ = std::max(box.diagonal().norm(), 1e-9);
    const Camera* previous = nullptr;
    for (const Camera& camera : cameras) {
      double knot = 0;
      Pose pose = PoseOf(camera, frame);
      if (previous) {
        const double separation = Separation(*previous, camera, path_size_);
        // A camera given twice in a row is one.
        if (separation < 1e-9) continue;
        knot = knots_.back() + std::sqrt(separation);
        if (frame.is_around) {
          // The shorter way around.
          const double before = poses_.back().numbers[0];
          pose.numbers[0] = before + std::remainder(pose.numbers[0] - before, 2 * M_PI);
        }
      }
      poses_.push_back(pose);
      knots_.push_back(knot);
      previous = &camera;
    }
  }

  double Length() const { return knots_.back(); }
  double PathSize() const { return path_size_; }

  Camera At(double t) const {
    const int last = static_cast<int>(poses_.size()) - 1;
    if (last == 0) return CameraOf(poses_.front(), frame_, like_);
    const int segment = std::clamp(
        static_cast<int>(std::upper_bound(knots_.begin(), knots_.end(), t) - knots_.begin()) - 1,
        0,
        last - 1);
    std::array<Pose, 4> poses;
    std::array<double, 4> knots;
    for (int i = 0; i < 4; ++i) {
      const int index = segment - 1 + i;
      poses[i] = poses_[std::clamp(index, 0, last)];
      // Before the first camera and after the last the path stands still for a while.
      const double step = knots_[segment + 1] - knots_[segment];
      knots[i] = index < 0      ? knots_.front() - step
                 : index > last ? knots_.back() + step
                                : knots_[index];
    }
    return CameraOf(CatmullRom(poses, knots, t), frame_, like_);
  }

 private:
  PoseFrame frame_;
  Camera like_;
  std::vector<Pose> poses_;
  std::vector<double> knots_;
  double path_size_ = 1;
};

// 0 to 1, gently at both ends: an even pace but for the first and last eighth of the time.
double EasedShare(double share) {
  constexpr double kRamp = 0.125;
  constexpr double kPace = 1 / (1 - kRamp);
  if (share < kRamp) return kPace * share * share / (2 * kRamp);
  if (share > 1 - kRamp) return 1 - kPace * (1 - share) * (1 - share) / (2 * kRamp);
  return kPace * (share - kRamp / 2);
}

}  // namespace

Camera ReframedCamera(const Camera& camera, int width_px, int height_px) {
  Camera reframed = camera;
  const double scale = static_cast<double>(width_px) / camera.width_px;
  const double scale_y = scale * camera.focal_x_px / camera.focal_y_px;
  reframed.width_px = width_px;
  reframed.height_px = height_px;
  reframed.focal_x_px = reframed.focal_y_px = scale * camera.focal_x_px;
  reframed.center_x_px = scale * camera.center_x_px;
  reframed.center_y_px = height_px / 2.0 + scale_y * (camera.center_y_px - camera.height_px / 2.0);
  return reframed;
}

Camera FittedCamera(const Camera& camera, int width_px, int height_px) {
  Camera fitted = camera;
  fitted.width_px = width_px;
  fitted.height_px = height_px;
  fitted.focal_x_px = fitted.focal_y_px =
      std::min(width_px * camera.focal_x_px / camera.width_px,
               height_px * camera.focal_y_px / camera.height_px);
  const auto center = [&](double center_px, int frame_px, double focal_px, int fitted_frame_px) {
    return fitted_frame_px / 2.0 + (center_px - frame_px / 2.0) / focal_px * fitted.focal_x_px;
  };
  fitted.center_x_px = center(camera.center_x_px, camera.width_px, camera.focal_x_px, width_px);
  fitted.center_y_px = center(camera.center_y_px, camera.height_px, camera.focal_y_px, height_px);
  return fitted;
}

ImageSize CommonFrame(const std::vector<Camera>& cameras) {
  std::map<std::pair<int, int>, int> counts;
  for (const Camera& camera : cameras) ++counts[{camera.width_px, camera.height_px}];
  // Lying before upright where both are as many and as large: films are watched lying.
  const auto rank = [](const auto& entry) {
    const auto [width, height] = entry.first;
    return std::tuple(entry.second, static_cast<int64_t>(width) * height, width);
  };
  const auto best =
      std::max_element(counts.begin(), counts.end(), [&](const auto& a, const auto& b) {
        return rank(a) < rank(b);
      });
  return best == counts.end() ? ImageSize{} : ImageSize{best->first.first, best->first.second};
}

std::vector<Camera> MakeFlight(const PolygonModel& model,
                               const std::vector<Camera>& views,
                               int num_frames) {
  if (views.empty()) throw Error("camera path: it needs at least one view");
  if (num_frames < 1) throw Error("camera path: it needs at least one frame");
  const ImageSize size = CommonFrame(views);
  std::vector<Camera> cameras = views;
  for (Camera& camera : cameras) {
    if (camera.width_px == size.width && camera.height_px == size.height) continue;
    camera = FittedCamera(camera, size.width, size.height);
  }
  const Curve curve(cameras, ChoosePoseFrame(model, cameras));

  // How far the path has come at each of many knots, so that it can be walked at an even pace.
  const int num_steps = 64 * static_cast<int>(cameras.size());
  std::vector<double> come = {0};
  Camera previous = curve.At(0);
  for (int step = 1; step <= num_steps; ++step) {
    const Camera next = curve.At(curve.Length() * step / num_steps);
    come.push_back(come.back() + Separation(previous, next, curve.PathSize()));
    previous = next;
  }

  std::vector<Camera> path;
  for (int frame = 0; frame < num_frames; ++frame) {
    const double share = num_frames > 1 ? static_cast<double>(frame) / (num_frames - 1) : 0;
    const double wanted = EasedShare(share) * come.back();
    const int step = std::clamp(
        static_cast<int>(std::upper_bound(come.begin(), come.end(), wanted) - come.begin()) - 1,
        0,
        num_steps - 1);
    const double within = come[step + 1] - come[step];
    const double part = within > 0 ? (wanted - come[step]) / within : 0;
    path.push_back(curve.At(curve.Length() * (step + part) / num_steps));
  }
  return path;
}

void OrbitOptions::Check() const {
  CheckFromTo(width_px, 1, 65536, "orbit options: width_px");
  CheckFromTo(height_px, 1, 65536, "orbit options: height_px");
  CheckFromTo(view_angle_deg, 0.1, 150, "orbit options: view_angle_deg");
  CheckFromTo(height_deg, -89, 89, "orbit options: height_deg");
  CheckFinite(first_bearing_deg, "orbit options: first_bearing_deg");
}

std::vector<Camera> MakeOrbit(const PolygonModel& model,
                              int num_frames,
                              const OrbitOptions& options) {
  options.Check();
  if (num_frames < 1) throw Error("camera path: it needs at least one frame");
  const Box bounds = ComputeBuildingBounds(model);
  const Eigen::AlignedBox3d built(bounds.min, bounds.max);
  const Eigen::Vector3d middle = bounds.Center();
  Camera camera;
  camera.width_px = options.width_px;
  camera.height_px = options.height_px;
  camera.focal_x_px = camera.focal_y_px =
      options.width_px / 2.0 / std::tan(RadiansFromDegrees(options.view_angle_deg) / 2);
  camera.center_x_px = options.width_px / 2.0;
  camera.center_y_px = options.height_px / 2.0;

  // Near enough for the model to fill nine tenths of the frame, at the bearing that needs most.
  const double tangent_x = 0.9 * options.width_px / 2.0 / camera.focal_x_px;
  const double tangent_y = 0.9 * options.height_px / 2.0 / camera.focal_y_px;
  double distance = 1e-6;
  std::vector<Eigen::Matrix3d> rotations;
  for (int frame = 0; frame < num_frames; ++frame) {
    const double bearing =
        RadiansFromDegrees(options.first_bearing_deg) + 2 * M_PI * frame / num_frames;
    const double height = RadiansFromDegrees(options.height_deg);
    const Eigen::Vector3d forward(-std::sin(bearing) * std::cos(height),
                                  -std::cos(bearing) * std::cos(height),
                                  -std::sin(height));
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d down = forward.cross(right);
    Eigen::Matrix3d cam_from_world;
    cam_from_world << right.transpose(), down.transpose(), forward.transpose();
    rotations.push_back(cam_from_world);
    for (const Eigen::Vector3d& point : model.points_in_world) {
      if (!built.contains(point)) continue;
      const Eigen::Vector3d from_middle = cam_from_world * (point - middle);
      distance = std::max({distance,
                           std::abs(from_middle.x()) / tangent_x - from_middle.z(),
                           std::abs(from_middle.y()) / tangent_y - from_middle.z()});
    }
  }
  std::vector<Camera> path;
  for (const Eigen::Matrix3d& rotation : rotations) {
    camera.cam_from_world.rotation = rotation;
    camera.cam_from_world.translation = Eigen::Vector3d(0, 0, distance) - rotation * middle;
    path.push_back(camera);
  }
  return path;
}

}  // namespace groundglass
