// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/building_faces.h"
#include "scene/face_outline.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

const Rgb kTrim(0.46f, 0.43f, 0.36f);
const Rgb kFrameWhite(0.5f, 0.5f, 0.47f);
const Rgb kDoorWood(0.13f, 0.07f, 0.04f);

// Points of a wall: s along it, depth behind it, height.
struct WallFrame {
  Eigen::Vector2d from, along, inward;
  double length = 0;

  explicit WallFrame(const WallPiece& wall)
      : from(wall.from),
        along((wall.to - wall.from).normalized()),
        inward(-along.y(), along.x()),
        length((wall.to - wall.from).norm()) {}
  Eigen::Vector3d At(double s, double depth, double z) const {
    const Eigen::Vector2d place = from + s * along + depth * inward;
    return {place.x(), place.y(), z};
  }
};

// The opening's outline on the wall, counterclockwise seen from outside, from its lower left.
std::vector<Eigen::Vector2d> OutlineOf(const Opening& opening, double start_s) {
  const double left = opening.start_s - start_s;
  const double right = opening.end_s - start_s;
  if (!opening.is_arched) {
    return {{left, opening.low_z},
            {right, opening.low_z},
            {right, opening.high_z},
            {left, opening.high_z}};
  }
  constexpr int kArcs = 10;
  const double half = (right - left) / 2;
  const double rise = std::min(half, 0.4 * (opening.high_z - opening.low_z));
  std::vector<Eigen::Vector2d> outline = {{left, opening.low_z}, {right, opening.low_z}};
  for (int i = 0; i <= kArcs; ++i) {
    const double angle = std::numbers::pi * i / kArcs;
    outline.emplace_back(left + half + half * std::cos(angle),
                         opening.high_z - rise + rise * std::sin(angle));
  }
  return outline;
}

// The wall's outline with notches for doors that stand on its foot, and holes joined by bridges.
std::vector<Eigen::Vector2d> OutlineWithHoles(
    const WallPiece& wall,
    double length,
    const std::vector<std::vector<Eigen::Vector2d>>& openings) {
  std::vector<const std::vector<Eigen::Vector2d>*> notches;
  std::vector<const std::vector<Eigen::Vector2d>*> holes;
  for (const auto& opening : openings) {
    (opening[0].y() < wall.low + 1e-6 ? notches : holes).push_back(&opening);
  }
  std::sort(notches.begin(), notches.end(), [](const auto* a, const auto* b) {
    return (*a)[0].x() < (*b)[0].x();
  });
  std::vector<Eigen::Vector2d> points = {{0, wall.low}};
  for (const auto* notch : notches) {
    points.emplace_back((*notch)[0].x(), wall.low);
    points.insert(points.end(), notch->rbegin(), notch->rend() - 2);
    points.emplace_back((*notch)[1].x(), wall.low);
  }
  points.emplace_back(length, wall.low);
  points.emplace_back(length, wall.high_to);
  if (wall.apex > 0) points.emplace_back(length / 2, wall.apex);
  points.emplace_back(0, wall.high_from);
  OutlineLoops loops;
  loops.loops.resize(1);
  for (size_t i = 0; i < points.size(); ++i) loops.loops[0].corners.push_back(static_cast<int>(i));
  for (const auto* hole : holes) {
    OutlineLoops::Loop loop;
    loop.inside_of = 0;
    for (auto point = hole->rbegin(); point != hole->rend(); ++point) {
      loop.corners.push_back(static_cast<int>(points.size()));
      points.push_back(*point);
    }
    loops.loops.push_back(loop);
  }
  std::vector<Eigen::Vector2d> outline;
  const std::vector<int> bridged = BridgeHoles(points, loops)[0];
  for (const int corner : bridged) outline.push_back(points[corner]);
  return outline;
}

void AddPane(const WallFrame& frame,
             const std::vector<Eigen::Vector2d>& outline,
             const Opening& opening,
             double depth,
             bool has_mullions,
             const std::string& name,
             FaceList& faces) {
  const auto add = [&](const std::vector<Eigen::Vector2d>& part, double panes) {
    std::vector<Eigen::Vector3d> corners;
    for (const Eigen::Vector2d& point : part)
      corners.push_back(frame.At(point.x(), depth, point.y()));
    const Material material = opening.is_door ? Material::kPlain : Material::kWindowBand;
    faces.Add(corners, name, material, opening.is_door ? kDoorWood : kFrameWhite);
    faces.Last().panes = opening.is_door ? 0 : panes;
  };
  if (!has_mullions || opening.is_arched || opening.is_door || opening.num_panes < 2) {
    add(outline, opening.num_panes);
    return;
  }
  const double left = outline[0].x();
  const double width = (outline[1].x() - left) / opening.num_panes;
  for (int i = 0; i < opening.num_panes; ++i) {
    const double a = left + i * width;
    const double b = left + (i + 1) * width;
    add({{a, opening.low_z}, {b, opening.low_z}, {b, opening.high_z}, {a, opening.high_z}}, 1);
  }
}

void AddReveals(const WallFrame& frame,
                const std::vector<Eigen::Vector2d>& outline,
                double depth,
                const Body& body,
                const std::string& name,
                FaceList& faces) {
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((b - a).norm() < 1e-6) continue;
    faces.Add({frame.At(a.x(), 0, a.y()),
               frame.At(b.x(), 0, b.y()),
               frame.At(b.x(), depth, b.y()),
               frame.At(a.x(), depth, a.y())},
              name + " reveal",
              Material::kPlain,
              Rgb(0.6f * body.color + 0.4f * kTrim),
              true);
  }
}

// A bar of stone before the wall between two places and heights.
void AddBar(const WallFrame& frame,
            double start_s,
            double end_s,
            double low,
            double high,
            double out,
            const std::string& name,
            FaceList& faces) {
  const auto quad = [&](const Eigen::Vector3d& a,
                        const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c,
                        const Eigen::Vector3d& d) {
    faces.Add({a, b, c, d}, name, Material::kPlain, kTrim, true);
  };
  const double a = start_s;
  const double b = end_s;
  quad(frame.At(a, -out, low),
       frame.At(b, -out, low),
       frame.At(b, -out, high),
       frame.At(a, -out, high));
  quad(
      frame.At(a, -out, high), frame.At(b, -out, high), frame.At(b, 0, high), frame.At(a, 0, high));
  quad(frame.At(a, 0, low), frame.At(b, 0, low), frame.At(b, -out, low), frame.At(a, -out, low));
  quad(frame.At(a, 0, low), frame.At(a, -out, low), frame.At(a, -out, high), frame.At(a, 0, high));
  quad(frame.At(b, -out, low), frame.At(b, 0, low), frame.At(b, 0, high), frame.At(b, -out, high));
}

// A bar along the whole wall, but where openings are.
void AddLedge(const WallPiece& wall,
              const WallFrame& frame,
              const std::vector<Opening>& openings,
              double low,
              double high,
              double out,
              const std::string& name,
              FaceList& faces) {
  std::vector<std::pair<double, double>> gaps;
  for (const Opening& opening : openings) {
    if (opening.low_z - 0.3 > high || opening.high_z + 0.3 < low) continue;
    gaps.emplace_back(opening.start_s - wall.start_s - 0.2, opening.end_s - wall.start_s + 0.2);
  }
  std::sort(gaps.begin(), gaps.end());
  // At a corner that stands out, one of the two bars goes around it.
  double start = 0;
  const double end = frame.length + (wall.bends_to ? out : 0);
  gaps.emplace_back(end, end);
  for (const auto& [gap_start, gap_end] : gaps) {
    if (gap_start - start > 0.1) AddBar(frame, start, gap_start, low, high, out, name, faces);
    start = std::max(start, gap_end);
  }
}

void AddLedges(const Body& body,
               const WallPiece& wall,
               const WallFrame& frame,
               const std::vector<Opening>& openings,
               const std::string& name,
               FaceList& faces) {
  const auto add = [&](double low, double high, double out, const std::string& what) {
    AddLedge(wall, frame, openings, low, high, out, name + " " + what, faces);
  };
  if (body.has_plinth) add(body.base, body.base + 1.8, 0.2, "plinth");
  for (const double height : body.course_heights) {
    if (height < wall.high_from - 1) add(height, height + 0.6, 0.25, "string course");
  }
  if (body.cornice > 0 && wall.apex == 0) {
    const double top = std::min(wall.high_from, wall.high_to) - 0.4;
    add(top - 0.7, top, body.cornice, "cornice");
    add(top - 1.2, top - 0.7, body.cornice / 2, "cornice foot");
  }
}

}  // namespace

void AddWallPiece(const Body& body,
                  const WallPiece& wall,
                  const std::vector<Opening>& openings,
                  const BuildingDetail& detail,
                  const std::string& name,
                  FaceList& faces) {
  const WallFrame frame(wall);
  const bool has_openings =
      body.is_neighbour ? detail.neighbours_have_openings : detail.has_openings;
  const double depth = body.is_neighbour ? 0 : detail.recess;
  std::vector<std::vector<Eigen::Vector2d>> outlines;
  if (has_openings) {
    for (const Opening& opening : openings) outlines.push_back(OutlineOf(opening, wall.start_s));
  }
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector2d& point : OutlineWithHoles(wall, frame.length, outlines)) {
    corners.push_back(frame.At(point.x(), 0, point.y()));
  }
  faces.Add(corners, name, body.material, body.color);
  faces.Last().start_u = wall.start_s;
  for (size_t i = 0; i < outlines.size(); ++i) {
    const std::string own =
        name + (openings[i].is_door ? " door" : " window " + std::to_string(i + 1));
    AddPane(frame, outlines[i], openings[i], depth, detail.has_mullions, own, faces);
    if (depth > 0) AddReveals(frame, outlines[i], depth, body, own, faces);
    if (detail.has_sills && !body.is_neighbour && !openings[i].is_door) {
      const double left = outlines[i][0].x() - 0.25;
      const double right = outlines[i][1].x() + 0.25;
      AddBar(frame,
             left,
             right,
             openings[i].low_z - 0.35,
             openings[i].low_z,
             0.25,
             own + " sill",
             faces);
    }
  }
  if (detail.has_ledges && !body.is_neighbour) {
    AddLedges(body, wall, frame, openings, name, faces);
  }
}

}  // namespace groundglass
