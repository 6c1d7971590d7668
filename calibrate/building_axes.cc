// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/building_axes.h"

#include "scene/frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace groundglass {
namespace {

constexpr std::array<double, 9> kViewAngles_deg = {18, 24, 31, 39, 48, 58, 69, 81, 94};
constexpr int kDrawsPerAngle = 500;
constexpr size_t kMostSegments = 250;  // the longest
// A segment follows a direction within this; degrees.
constexpr double kFollows_deg = 1.5;
// Longer segments count no more than this; shares of the width.
constexpr double kLongest = 0.15;

// A segment in shares of the width from the picture's middle.
struct Chord {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  double weight = 0;
};

// The plane through the camera and the chord.
Eigen::Vector3d PlaneOf(const Chord& chord, double focal) {
  const Eigen::Vector3d through(chord.middle.x() / focal, chord.middle.y() / focal, 1);
  const Eigen::Vector3d along(chord.direction.x(), chord.direction.y(), 0);
  return through.cross(along).normalized();
}

// Level, level, down; false where no direction is near the picture's vertical.
bool OrderAxes(Eigen::Matrix3d& axes) {
  int vertical = 0;
  axes.row(1).cwiseAbs().maxCoeff(&vertical);
  if (std::abs(axes(1, vertical)) < std::sqrt(0.5)) return false;
  axes.col(vertical).swap(axes.col(2));
  if (axes(1, 2) < 0) axes.col(2) *= -1;
  if (axes.determinant() < 0) axes.col(0).swap(axes.col(1));
  return true;
}

double Score(const std::vector<Chord>& chords, const LinesCamera& camera) {
  const double most_sine = std::sin(RadiansFromDegrees(kFollows_deg));
  double score = 0;
  for (const Chord& chord : chords) {
    double least = most_sine;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector2d expected =
          DirectionInPicture(camera, chord.middle, camera.axes_in_cam.col(axis));
      const double sine = expected.x() * chord.direction.y() - expected.y() * chord.direction.x();
      if (!expected.isZero()) least = std::min(least, std::abs(sine));
    }
    score += chord.weight * (1 - least * least / (most_sine * most_sine));
  }
  return score;
}

}  // namespace

Eigen::Vector2d DirectionInPicture(const LinesCamera& camera,
                                   const Eigen::Vector2d& place,
                                   const Eigen::Vector3d& direction_in_cam) {
  const Eigen::Vector2d distorted = (place - camera.center) / camera.focal;
  Eigen::Vector2d straight = distorted;
  if (camera.k1 != 0) {
    for (int i = 0; i < 6; ++i) straight = distorted / (1 + camera.k1 * straight.squaredNorm());
  }
  const Eigen::Vector2d towards = direction_in_cam.head<2>() - direction_in_cam.z() * straight;
  const Eigen::Vector2d seen = (1 + camera.k1 * straight.squaredNorm()) * towards +
                               2 * camera.k1 * straight.dot(towards) * straight;
  const double length = seen.norm();
  return length < 1e-9 ? Eigen::Vector2d::Zero() : Eigen::Vector2d(seen / length);
}

std::vector<LinesCamera> FindBuildingAxes(std::span<const LineSegment> segments,
                                          const Eigen::Vector2d& middle_px,
                                          double width_px,
                                          uint64_t seed) {
  std::vector<Chord> chords;
  for (const LineSegment& segment : segments.first(std::min(segments.size(), kMostSegments))) {
    chords.push_back({(segment.Middle() - middle_px) / width_px,
                      segment.Direction(),
                      std::min(segment.Length() / width_px, kLongest)});
  }
  if (chords.size() < 3) return {};
  struct Scored {
    LinesCamera camera;
    double score = 0;
  };
  std::vector<Scored> best_of_angle;
  std::mt19937_64 random(seed);
  const auto draw = [&]() -> const Chord& { return chords[random() % chords.size()]; };
  for (const double angle_deg : kViewAngles_deg) {
    Scored best;
    LinesCamera camera;
    camera.focal = 0.5 / std::tan(RadiansFromDegrees(angle_deg) / 2);
    for (int i = 0; i < kDrawsPerAngle; ++i) {
      const Eigen::Vector3d first =
          PlaneOf(draw(), camera.focal).cross(PlaneOf(draw(), camera.focal));
      const Eigen::Vector3d second = first.cross(PlaneOf(draw(), camera.focal));
      if (first.norm() < 1e-3 || second.norm() < 1e-3 * first.norm()) continue;
      camera.axes_in_cam.col(0) = first.normalized();
      camera.axes_in_cam.col(1) = second.normalized();
      camera.axes_in_cam.col(2) = camera.axes_in_cam.col(0).cross(camera.axes_in_cam.col(1));
      if (!OrderAxes(camera.axes_in_cam)) continue;
      const double score = Score(chords, camera);
      if (score > best.score) best = {camera, score};
    }
    if (best.score > 0) best_of_angle.push_back(best);
  }
  std::stable_sort(best_of_angle.begin(), best_of_angle.end(), [](const auto& a, const auto& b) {
    return a.score > b.score;
  });
  std::vector<LinesCamera> cameras;
  for (const Scored& scored : best_of_angle) cameras.push_back(scored.camera);
  return cameras;
}

}  // namespace groundglass
