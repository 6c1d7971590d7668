// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Single faces whose points run the wrong way round. Photographs see their backs and never their
// fronts; that alone is right of a roof seen from beneath, or of a thin wall. A turned face has its
// front within the building as well, or runs along its edges as faces do not that show their
// fronts (in a closed mesh neighbours run along an edge in opposite directions).
#include "scene/advice/advice_parts.h"
#include "scene/advice/advice_suitability.h"
#include "scene/advice/turned_faces.h"
#include "scene/building_bounds.h"
#include "scene/face_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

// Rays across and down a frame, and how many of them must meet a back for it to be seen.
constexpr int kSightRaysAcross = 60;
constexpr int kSightRaysDown = 40;
constexpr int kFewestRays = 4;

struct FaceSight {
  int num_fronts = 0;            // rays
  int num_backs = 0;             // rays
  int num_photographs_back = 0;  // that show its back
};

std::vector<FaceSight> FindSights(const Scene& scene, const Visibility& visibility) {
  std::vector<FaceSight> sights(scene.model.faces.size());
  for (const Photograph* photograph : SomePhotographs(scene)) {
    if (FindTagFault(photograph->tag)) continue;
    const ImageSize& size = photograph->size;
    const Camera camera = CameraFromTag(photograph->tag, size.width, size.height);
    std::map<int, int> backs;
    for (int y = 0; y < kSightRaysDown; ++y) {
      for (int x = 0; x < kSightRaysAcross; ++x) {
        const Eigen::Vector2d image_px((x + 0.5) * size.width / kSightRaysAcross,
                                       (y + 0.5) * size.height / kSightRaysDown);
        const auto hit = visibility.FirstHit(camera.PositionInWorld(),
                                             UnprojectToWorld(camera, image_px).normalized());
        if (!hit) continue;
        FaceSight& sight = sights[static_cast<size_t>(hit->face)];
        (hit->is_front ? sight.num_fronts : sight.num_backs) += 1;
        if (!hit->is_front) ++backs[hit->face];
      }
    }
    for (const auto& [face, num_rays] : backs) {
      if (num_rays >= kFewestRays) ++sights[static_cast<size_t>(face)].num_photographs_back;
    }
  }
  return sights;
}

// A place on the face, within its largest triangle.
Eigen::Vector3d PlaceOn(const PolygonModel& model, int face) {
  Eigen::Vector3d place = model.points_in_world[model.faces[face].points[0]];
  double largest = 0;
  for (const std::array<int, 3>& triangle : TriangulateFace(model, face)) {
    const Eigen::Vector3d& a = model.points_in_world[triangle[0]];
    const Eigen::Vector3d& b = model.points_in_world[triangle[1]];
    const Eigen::Vector3d& c = model.points_in_world[triangle[2]];
    const double area = (b - a).cross(c - a).norm();
    if (area <= largest) continue;
    largest = area;
    place = (a + b + c) / 3;
  }
  return place;
}

// Of the directions to one side of a face, the share in which the model lies, or the ground under
// it, which few models have.
double EnclosedShare(const Visibility& visibility,
                     const Box& bounds,
                     const Eigen::Vector3d& place,
                     const Eigen::Vector3d& normal) {
  constexpr int kRings = 4;
  constexpr int kAround = 12;
  const Eigen::Vector3d across = normal.unitOrthogonal();
  const Eigen::Vector3d other = normal.cross(across);
  const Eigen::Vector3d origin = place + visibility.DefaultTolerance() * normal;
  int num_enclosed = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double height = (ring + 0.5) / kRings;
    const double radius = std::sqrt(1 - height * height);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (ring % 2)) / kAround;
      const Eigen::Vector3d direction =
          height * normal + radius * (std::cos(angle) * across + std::sin(angle) * other);
      if (visibility.FirstHit(origin, direction)) {
        ++num_enclosed;
        continue;
      }
      if (direction.z() >= 0) continue;
      const Eigen::Vector3d ground =
          origin + direction * ((bounds.min.z() - origin.z()) / direction.z());
      const bool is_under_it = ground.x() > bounds.min.x() && ground.x() < bounds.max.x() &&
                               ground.y() > bounds.min.y() && ground.y() < bounds.max.y();
      if (is_under_it) ++num_enclosed;
    }
  }
  return static_cast<double>(num_enclosed) / (kRings * kAround);
}

// How long a face runs along faces whose fronts are seen, in their opposite direction (as in a
// closed mesh) and in the same.
struct EdgeRun {
  double opposite = 0;
  double same = 0;
};

std::vector<EdgeRun> FindRuns(const PolygonModel& model,
                              const std::vector<FaceSight>& sights,
                              double same_place) {
  struct Side {
    int face;
    bool is_forward;
    double length;
  };
  // Corners at one place are one, though many programs write them for each face.
  std::map<std::array<long long, 3>, int> number_of;
  const auto number = [&](const Eigen::Vector3d& point) {
    const std::array<long long, 3> cell = {std::llround(point.x() / same_place),
                                           std::llround(point.y() / same_place),
                                           std::llround(point.z() / same_place)};
    return number_of.emplace(cell, static_cast<int>(number_of.size())).first->second;
  };
  std::map<std::pair<int, int>, std::vector<Side>> sides_of;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const std::vector<int>& points = model.faces[face].points;
    for (const OutlineSide& side : FindBorders(model, face)) {
      const Eigen::Vector3d& start = model.points_in_world[points[side.start]];
      const Eigen::Vector3d& end = model.points_in_world[points[side.end]];
      const int a = number(start);
      const int b = number(end);
      if (a == b) continue;
      sides_of[std::minmax(a, b)].push_back({face, a < b, (end - start).norm()});
    }
  }
  std::vector<EdgeRun> runs(model.faces.size());
  for (const auto& [edge, sides] : sides_of) {
    if (sides.size() != 2) continue;  // a border, or one where several walls meet
    for (const auto& [own, other] :
         {std::pair(sides[0], sides[1]), std::pair(sides[1], sides[0])}) {
      const FaceSight& sight = sights[static_cast<size_t>(other.face)];
      if (sight.num_fronts <= sight.num_backs) continue;
      EdgeRun& run = runs[static_cast<size_t>(own.face)];
      (own.is_forward == other.is_forward ? run.same : run.opposite) += own.length;
    }
  }
  return runs;
}

}  // namespace

std::vector<TurnedFace> FindTurnedFaces(const Scene& scene) {
  // The front lies within the building, and the back does not.
  constexpr double kWithin = 0.85;
  constexpr double kFreer = 0.35;
  const PolygonModel& model = scene.model;
  if (model.faces.empty()) return {};
  const Visibility visibility(model);
  const Box bounds = ComputeBuildingBounds(model);
  const std::vector<FaceSight> sights = FindSights(scene, visibility);
  const std::vector<EdgeRun> runs = FindRuns(model, sights, visibility.DefaultTolerance() / 10);
  std::vector<TurnedFace> turned;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const FaceSight& sight = sights[static_cast<size_t>(face)];
    if (sight.num_fronts > 0 || sight.num_photographs_back == 0) continue;
    const Eigen::Vector3d place = PlaceOn(model, face);
    const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
    const double front = EnclosedShare(visibility, bounds, place, normal);
    const double back = EnclosedShare(visibility, bounds, place, -normal);
    const EdgeRun& run = runs[static_cast<size_t>(face)];
    const bool is_within = front >= kWithin && front - back >= kFreer && run.opposite <= run.same;
    const bool runs_wrongly = run.same > run.opposite && front >= back;
    if (is_within || runs_wrongly) turned.push_back({face, sight.num_photographs_back});
  }
  return turned;
}

std::string DescribeTurnedFace(const PolygonModel& model, const TurnedFace& turned) {
  return DescribeFace(model, turned.face) + " is seen from its back in " +
         std::to_string(turned.num_photographs) +
         (turned.num_photographs == 1 ? " photograph" : " photographs") +
         "; its front is never seen";
}

bool AdviseOnWinding(const AdviceContext& context) {
  constexpr size_t kMostSingle = 3;
  const PolygonModel& model = context.scene.model;
  const std::vector<TurnedFace> turned = FindTurnedFaces(context.scene);
  const std::string file = context.scene.model_file.string();
  const char* const why = "as it is, it takes no texture: turn it where the model was made";
  if (turned.size() <= kMostSingle) {
    for (const TurnedFace& one : turned) {
      context.Add(Advice::Severity::kDetail, file, DescribeTurnedFace(model, one), why);
    }
    return !turned.empty();
  }
  std::vector<std::string> names;
  for (const TurnedFace& one : turned) names.push_back(DescribeFace(model, one.face));
  const bool are_most = 2 * turned.size() > model.faces.size();
  context.Add(Advice::Severity::kDetail,
              file,
              std::to_string(turned.size()) + " of " + std::to_string(model.faces.size()) +
                  " faces are seen from their backs, and their fronts never: " + ListNames(names),
              std::string("as they are, they take no texture: turn them where the model was made") +
                  (are_most ? "; or give --flip-faces, and turn the others" : ""));
  return true;
}

}  // namespace groundglass
