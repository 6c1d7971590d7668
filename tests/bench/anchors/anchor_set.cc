// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/anchor_set.h"

#include "scene/text.h"

#include <random>

namespace groundglass {
namespace {

// Errors of position (3), look-at point (3) and roll, world units and degrees.
using StartErrors = Eigen::Matrix<double, 7, 1>;

ViewTag Disturbed(const ViewTag& truth, const StartErrors& errors) {
  ViewTag tag = truth;
  tag.position_in_site += errors.head<3>();
  tag.lookat_in_site += errors.segment<3>(3);
  tag.roll_deg += errors[6];
  return tag;
}

// One standard deviation each for a scale of 1: position and look-at point in world units, roll in
// degrees.
constexpr double kBaseSigmaPosition = 1.0;
constexpr double kBaseSigmaLookat = 0.5;
constexpr double kBaseSigmaRollDeg = 0.5;

StartErrors DrawErrors(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  StartErrors errors;
  for (int i = 0; i < 7; ++i) {
    errors[i] = normal(random) *
                (i < 3 ? kBaseSigmaPosition : (i < 6 ? kBaseSigmaLookat : kBaseSigmaRollDeg));
  }
  return errors;
}

// The factor by which these errors make a vertex error of error_px.
double ScaleTo(const AnchorSet& set,
               const AnchorSet::Frame& frame,
               const StartErrors& errors,
               double error_px) {
  const Camera truth = TrueCamera(frame);
  const auto error_at = [&](double scale) {
    return VertexErrorPx(
        set.model,
        truth,
        CameraFromTag(Disturbed(frame.tag, scale * errors), frame.grey8.width, frame.grey8.height));
  };
  double low = 0;
  double high = 50;
  for (int step = 0; step < 50; ++step) {
    const double scale = (low + high) / 2;
    (error_at(scale) < error_px ? low : high) = scale;
  }
  return low;
}

}  // namespace

std::string FormatCao(const AnchorSet& set) {
  std::string text = "V1\n" + std::to_string(set.model.points_in_world.size()) + "\n";
  for (const Eigen::Vector3d& point_in_world : set.model.points_in_world) {
    const Eigen::Vector3d point = set.world_from_visp.transpose() * point_in_world / kWorldPerVisp;
    text += FormatNumber(point.x()) + " " + FormatNumber(point.y()) + " " +
            FormatNumber(point.z()) + "\n";
  }
  text += "0\n0\n" + std::to_string(set.model.faces.size()) + "\n";
  for (const Face& face : set.model.faces) {
    text += std::to_string(face.points.size());
    for (const int point : face.points) text += " " + std::to_string(point);
    text += "\n";
  }
  return text + "0\n0\n";
}

Camera TrueCamera(const AnchorSet::Frame& frame) {
  return CameraFromTag(frame.tag, frame.grey8.width, frame.grey8.height);
}

std::vector<PerturbedStart> MakeStarts(const AnchorSet& set,
                                       double error_px,
                                       int count,
                                       uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<PerturbedStart> starts;
  for (int i = 0; i < count; ++i) {
    PerturbedStart& start = starts.emplace_back();
    start.frame = static_cast<int>(i * set.frames.size() / count);
    const AnchorSet::Frame& frame = set.frames[start.frame];
    const StartErrors errors = DrawErrors(random);
    const double scale = ScaleTo(set, frame, errors, error_px);
    start.tag = Disturbed(frame.tag, scale * errors);
    TagSigmas& sigmas = start.tag.sigmas;
    sigmas.position = sigmas.height = kBaseSigmaPosition * scale;
    sigmas.lookat = kBaseSigmaLookat * scale;
    sigmas.roll_deg = kBaseSigmaRollDeg * scale;
  }
  return starts;
}

double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found) {
  double sum = 0;
  int count = 0;
  for (const Face& face : model.faces) {
    for (const int corner : face.points) {
      const Eigen::Vector3d& point = model.points_in_world[corner];
      const auto a = Project(truth, point);
      if (!a || !IsInsideFrame(truth, *a)) continue;
      const auto b = Project(found, point);
      if (!b) return 1e6;
      sum += (*a - *b).norm();
      ++count;
    }
  }
  return count ? sum / count : 1e6;
}

}  // namespace groundglass
