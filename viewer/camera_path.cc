// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/camera_path.h"

#include "scene/error.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace groundglass {
namespace {

// A camera as numbers that may be interpolated, its rotation apart.
struct Pose {
  // Position in world, focal lengths, principal point, k1, k2.
  Eigen::Matrix<double, 9, 1> numbers = Eigen::Matrix<double, 9, 1>::Zero();
  Eigen::Quaterniond world_from_cam = Eigen::Quaterniond::Identity();
};

Pose PoseOf(const Camera& camera) {
  Pose pose;
  pose.numbers << camera.PositionInWorld(), camera.focal_x_px, camera.focal_y_px,
      camera.center_x_px, camera.center_y_px, camera.k1, camera.k2;
  pose.world_from_cam = Eigen::Quaterniond(camera.cam_from_world.rotation.transpose());
  return pose;
}

Camera CameraOf(const Pose& pose, const Camera& like) {
  Camera camera = like;
  camera.focal_x_px = pose.numbers[3];
  camera.focal_y_px = pose.numbers[4];
  camera.center_x_px = pose.numbers[5];
  camera.center_y_px = pose.numbers[6];
  camera.k1 = pose.numbers[7];
  camera.k2 = pose.numbers[8];
  camera.cam_from_world.rotation = pose.world_from_cam.normalized().toRotationMatrix().transpose();
  camera.cam_from_world.translation = -(camera.cam_from_world.rotation * pose.numbers.head<3>());
  return camera;
}

// The pose at time t on the straight way from a (at t_a) to b (at t_b); outside them, beyond.
Pose Blend(const Pose& a, const Pose& b, double t_a, double t_b, double t) {
  const double share = (t - t_a) / (t_b - t_a);
  return {(1 - share) * a.numbers + share * b.numbers,
          a.world_from_cam.slerp(share, b.world_from_cam)};
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

// How far apart two poses look: metres and turns do not compare, so the way is counted in sizes of
// the whole path and the turn in half circles.
double Separation(const Pose& a, const Pose& b, double path_size) {
  const double way = (a.numbers.head<3>() - b.numbers.head<3>()).norm();
  return way / path_size + a.world_from_cam.angularDistance(b.world_from_cam) / M_PI;
}

// A curve through poses at knots.
class Curve {
 public:
  explicit Curve(const std::vector<Pose>& poses) {
    Eigen::AlignedBox3d box;
    for (const Pose& pose : poses) box.extend(Eigen::Vector3d(pose.numbers.head<3>()));
    path_size_ = std::max(box.diagonal().norm(), 1e-9);
    for (const Pose& pose : poses) {
      // A camera given twice in a row is one.
      if (!poses_.empty() && Separation(poses_.back(), pose, path_size_) < 1e-9) continue;
      const double knot =
          poses_.empty() ? 0
                         : knots_.back() + std::sqrt(Separation(poses_.back(), pose, path_size_));
      poses_.push_back(pose);
      knots_.push_back(knot);
    }
  }

  double Length() const { return knots_.back(); }
  double PathSize() const { return path_size_; }

  Pose At(double t) const {
    const int last = static_cast<int>(poses_.size()) - 1;
    if (last == 0) return poses_.front();
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
    return CatmullRom(poses, knots, t);
  }

 private:
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

std::vector<Camera> MakeFlight(const std::vector<Camera>& cameras, int num_frames) {
  if (cameras.empty()) throw Error("camera path: it needs at least one view");
  if (num_frames < 1) throw Error("camera path: it needs at least one frame");
  std::vector<Pose> poses;
  for (const Camera& camera : cameras) {
    if (camera.width_px != cameras.front().width_px ||
        camera.height_px != cameras.front().height_px) {
      throw Error("camera path: all its views must have one frame size");
    }
    poses.push_back(PoseOf(camera));
  }
  const Curve curve(poses);

  // How far the path has come at each of many knots, so that it can be walked at an even pace.
  const int num_steps = 64 * static_cast<int>(cameras.size());
  std::vector<double> come = {0};
  Pose previous = curve.At(0);
  for (int step = 1; step <= num_steps; ++step) {
    const Pose next = curve.At(curve.Length() * step / num_steps);
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
    path.push_back(CameraOf(curve.At(curve.Length() * (step + part) / num_steps), cameras.front()));
  }
  return path;
}

void OrbitOptions::Check() const {
  if (width_px < 1 || height_px < 1)
    throw Error("orbit options: width_px and height_px must be > 0");
  if (!(view_angle_deg > 0 && view_angle_deg < 150)) {
    throw Error("orbit options: view_angle_deg must be in (0, 150)");
  }
  if (!(height_deg > -89 && height_deg < 89)) {
    throw Error("orbit options: height_deg must be in (-89, 89)");
  }
}

std::vector<Camera> MakeOrbit(const PolygonModel& model,
                              int num_frames,
                              const OrbitOptions& options) {
  options.Check();
  if (num_frames < 1) throw Error("camera path: it needs at least one frame");
  const Eigen::Vector3d middle = ComputeBounds(model).Center();
  double radius = 1e-6;
  for (const Eigen::Vector3d& point : model.points_in_world) {
    radius = std::max(radius, (point - middle).norm());
  }
  Camera camera;
  camera.width_px = options.width_px;
  camera.height_px = options.height_px;
  camera.focal_x_px = camera.focal_y_px =
      options.width_px / 2.0 / std::tan(RadiansFromDegrees(options.view_angle_deg) / 2);
  camera.center_x_px = options.width_px / 2.0;
  camera.center_y_px = options.height_px / 2.0;
  // The sphere around the model touches the frame's nearer borders.
  const double half_angle =
      std::atan(std::min(options.width_px, options.height_px) / 2.0 / camera.focal_x_px);
  const double distance = radius / std::sin(half_angle);

  std::vector<Camera> path;
  for (int frame = 0; frame < num_frames; ++frame) {
    const double bearing =
        RadiansFromDegrees(options.first_bearing_deg) + 2 * M_PI * frame / num_frames;
    const double height = RadiansFromDegrees(options.height_deg);
    const Eigen::Vector3d out(std::sin(bearing) * std::cos(height),
                              std::cos(bearing) * std::cos(height),
                              std::sin(height));
    const Eigen::Vector3d forward = -out;
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d down = forward.cross(right);
    camera.cam_from_world.rotation << right.transpose(), down.transpose(), forward.transpose();
    camera.cam_from_world.translation =
        -(camera.cam_from_world.rotation * (middle + distance * out));
    path.push_back(camera);
  }
  return path;
}

}  // namespace groundglass
