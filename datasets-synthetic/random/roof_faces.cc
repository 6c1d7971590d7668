// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/building_faces.h"
#include "scene/face_outline.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

using Corners3 = std::vector<Eigen::Vector3d>;

// An upper side that faces up, from rings of the plan: an outer one, and one that is cut out.
Corners3 LevelRing(const std::vector<Eigen::Vector2d>& outer,
                   const std::vector<Eigen::Vector2d>& hole,
                   double z) {
  std::vector<Eigen::Vector2d> points = outer;
  points.insert(points.end(), hole.begin(), hole.end());
  OutlineLoops loops;
  loops.loops.resize(hole.empty() ? 1 : 2);
  for (size_t i = 0; i < points.size(); ++i) {
    loops.loops[i < outer.size() ? 0 : 1].corners.push_back(static_cast<int>(i));
  }
  if (!hole.empty()) loops.loops[1].inside_of = 0;
  Corners3 corners;
  const std::vector<int> bridged = BridgeHoles(points, loops)[0];
  for (const int i : bridged) {
    corners.push_back({points[i].x(), points[i].y(), z});
  }
  return corners;
}

void AddFlatRoof(const Body& body, const BuildingDetail& detail, FaceList& faces) {
  const bool is_round = detail.has_round_corners;
  const bool has_parapet = detail.has_parapets && body.parapet > 0 && !body.is_neighbour;
  const double top = body.eaves + body.parapet;
  const double inset = has_parapet ? 0.9 : 0;
  const std::vector<Eigen::Vector2d> ring = RingOf(body, false, inset, is_round);
  std::vector<Eigen::Vector2d> court;
  if (!body.court.empty()) court = RingOf(body, true, inset, is_round);
  faces.Add(LevelRing(ring, court, has_parapet ? body.eaves : top),
            body.name + " roof",
            body.roof_material,
            body.roof_color);
  if (!has_parapet) return;
  const Rgb coping(0.42f, 0.4f, 0.36f);
  for (const bool of_court : {false, true}) {
    if (of_court && court.empty()) continue;
    const std::vector<Eigen::Vector2d>& inner = of_court ? court : ring;
    const std::vector<Eigen::Vector2d> outer = RingOf(body, of_court, 0, is_round);
    const size_t n = inner.size();
    for (size_t i = 0; i < n; ++i) {
      const size_t next = (i + 1) % n;
      // Where the next body stands, its wall takes the parapet's place.
      const Eigen::Vector2d way = outer[next] - outer[i];
      const Eigen::Vector2d aside = inner[i] - outer[i];
      if (std::abs(way.x() * aside.y() - way.y() * aside.x()) < 1e-6) continue;
      const auto at = [&](const Eigen::Vector2d& p, double z) {
        return Eigen::Vector3d(p.x(), p.y(), z);
      };
      faces.Add({at(outer[i], top), at(outer[next], top), at(inner[next], top), at(inner[i], top)},
                body.name + " coping",
                Material::kPlain,
                coping,
                true);
      faces.Add({at(inner[next], body.eaves),
                 at(inner[i], body.eaves),
                 at(inner[i], top),
                 at(inner[next], top)},
                body.name + " parapet",
                body.material,
                body.color,
                true);
    }
  }
}

// The part of a convex polygon on the side of a plane that its normal points to.
Corners3 ClippedBy(const Corners3& corners, const Eigen::Vector3d& normal, double offset) {
  Corners3 kept;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& a = corners[i];
    const Eigen::Vector3d& b = corners[(i + 1) % corners.size()];
    const double above_a = normal.dot(a) - offset;
    const double above_b = normal.dot(b) - offset;
    if (above_a >= -1e-9) kept.push_back(a);
    if ((above_a > 1e-9 && above_b < -1e-9) || (above_a < -1e-9 && above_b > 1e-9)) {
      kept.push_back(a + above_a / (above_a - above_b) * (b - a));
    }
  }
  return kept;
}

// The slopes of a roof over a rectangle whose ridge runs along its first axis: u along the ridge, v
// across. `out`: how far it hangs over.
struct RoofFrame {
  Eigen::Vector2d origin, along, across;
  double length = 0;
  double width = 0;
  Eigen::Vector3d At(double u, double v, double z) const {
    const Eigen::Vector2d place = origin + u * along + v * across;
    return {place.x(), place.y(), z};
  }
};

RoofFrame FrameOf(const Body& body) {
  const Eigen::Vector2d size = body.High() - body.Low();
  // Both frames turn counterclockwise from `along` to `across`.
  if (body.is_ridge_along_x) {
    return {body.Low(), Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY(), size.x(), size.y()};
  }
  return {Eigen::Vector2d(body.High().x(), body.Low().y()),
          Eigen::Vector2d::UnitY(),
          -Eigen::Vector2d::UnitX(),
          size.y(),
          size.x()};
}

std::vector<Corners3> GabledSlopes(const Body& body, double out, double far_start, double far_end) {
  const RoofFrame f = FrameOf(body);
  const double slope = (body.ridge - body.eaves) / (f.width / 2);
  const double low = body.eaves - out * slope;
  const double a = -far_start;
  const double b = f.length + far_end;
  return {{f.At(a, -out, low),
           f.At(b, -out, low),
           f.At(b, f.width / 2, body.ridge),
           f.At(a, f.width / 2, body.ridge)},
          {f.At(b, f.width + out, low),
           f.At(a, f.width + out, low),
           f.At(a, f.width / 2, body.ridge),
           f.At(b, f.width / 2, body.ridge)}};
}

std::vector<Corners3> HippedSlopes(const Body& body, double out) {
  RoofFrame f = FrameOf(body);
  const double run = std::min(f.width, f.length) / 2;
  const double slope = (body.ridge - body.eaves) / run;
  const double low = body.eaves - out * slope;
  const Eigen::Vector3d c0 = f.At(-out, -out, low);
  const Eigen::Vector3d c1 = f.At(f.length + out, -out, low);
  const Eigen::Vector3d c2 = f.At(f.length + out, f.width + out, low);
  const Eigen::Vector3d c3 = f.At(-out, f.width + out, low);
  if (std::abs(f.length - f.width) < 1e-6) {
    const Eigen::Vector3d tip = f.At(f.length / 2, f.width / 2, body.ridge);
    return {{c0, c1, tip}, {c1, c2, tip}, {c2, c3, tip}, {c3, c0, tip}};
  }
  // The ridge runs along the longer side.
  if (f.length > f.width) {
    const Eigen::Vector3d r0 = f.At(run, f.width / 2, body.ridge);
    const Eigen::Vector3d r1 = f.At(f.length - run, f.width / 2, body.ridge);
    return {{c0, c1, r1, r0}, {c1, c2, r1}, {c2, c3, r0, r1}, {c3, c0, r0}};
  }
  const Eigen::Vector3d r0 = f.At(f.length / 2, run, body.ridge);
  const Eigen::Vector3d r1 = f.At(f.length / 2, f.width - run, body.ridge);
  return {{c0, c1, r0}, {c1, c2, r1, r0}, {c2, c3, r1}, {c3, c0, r0, r1}};
}

// A hipped roof over a wing: gabled where it runs into the other body's slope.
std::vector<Corners3> WingSlopes(const Body& body, const Body& main, double out) {
  const bool at_street = body.Low().y() < main.Low().y();
  const double depth = main.High().y() - main.Low().y();
  // Far enough to come out behind the slope; what lies below it is clipped away.
  const double reach = depth / 2;
  std::vector<Corners3> slopes;
  if (main.roof == RoofKind::kHipped) {
    Body longer = body;
    for (PlanCorner& corner : longer.plan) {
      if (at_street && corner.at.y() > body.High().y() - 1e-6)
        corner.at.y() += reach + body.High().x() - body.Low().x();
      if (!at_street && corner.at.y() < body.Low().y() + 1e-6)
        corner.at.y() -= reach + body.High().x() - body.Low().x();
    }
    slopes = HippedSlopes(longer, out);
  } else {
    slopes = GabledSlopes(body, out, at_street ? out : reach, at_street ? reach : out);
  }
  const double steepness = (main.ridge - main.eaves) / (depth / 2);
  const double edge = at_street ? main.Low().y() : main.High().y();
  const double toward = at_street ? 1 : -1;
  const Eigen::Vector3d normal(0, -toward * steepness, 1);
  std::vector<Corners3> kept;
  for (const Corners3& slope : slopes) {
    Corners3 clipped = ClippedBy(slope, normal, main.eaves - toward * steepness * edge);
    if (clipped.size() >= 3) kept.push_back(clipped);
  }
  return kept;
}

std::vector<Corners3> MonoSlope(const Body& body, double out) {
  const Eigen::Vector2d low = body.Low();
  const Eigen::Vector2d high = body.High();
  const double slope = (body.ridge - body.eaves) / (high.y() - low.y());
  const bool leans = !body.plan[2].has_wall;  // against the wall behind it
  const double far = leans ? 0 : out;
  return {{{low.x() - out, low.y() - out, body.eaves - out * slope},
           {high.x() + out, low.y() - out, body.eaves - out * slope},
           {high.x() + out, high.y() + far, body.ridge + far * slope},
           {low.x() - out, high.y() + far, body.ridge + far * slope}}};
}

// A slope with the thickness of its boards: where it hangs over, its underside and rims are seen.
void AddSlab(const Body& body, const Corners3& slope, bool is_thick, FaceList& faces) {
  faces.Add(slope, body.name + " slope", body.roof_material, body.roof_color);
  if (!is_thick) return;
  const Rgb boards(0.3f, 0.28f, 0.25f);
  const Eigen::Vector3d down(0, 0, -0.55);
  Corners3 underside;
  for (auto corner = slope.rbegin(); corner != slope.rend(); ++corner) {
    underside.push_back(*corner + down);
  }
  faces.Add(underside, body.name + " soffit", Material::kPlain, boards, true);
  for (size_t i = 0; i < slope.size(); ++i) {
    const Eigen::Vector3d& a = slope[i];
    const Eigen::Vector3d& b = slope[(i + 1) % slope.size()];
    // Not where slopes meet: ridges, hips and valleys rise to the top.
    const bool is_eaves = std::abs(a.z() - b.z()) < 1e-6 && a.z() < body.eaves + 1e-6;
    const bool is_verge = body.roof == RoofKind::kMono ||
                          (body.roof == RoofKind::kGabled && std::abs(a.z() - b.z()) > 1e-6);
    if (!is_eaves && !is_verge) continue;
    faces.Add({a + down, b + down, b, a}, body.name + " fascia", Material::kPlain, boards, true);
  }
}

}  // namespace

void AddRoof(const Body& body, const Body& main, const BuildingDetail& detail, FaceList& faces) {
  if (body.roof == RoofKind::kFlat) {
    AddFlatRoof(body, detail, faces);
    return;
  }
  const double out = detail.has_overhangs ? body.overhang : 0;
  std::vector<Corners3> slopes;
  if (body.runs_into >= 0) {
    slopes = WingSlopes(body, main, out);
  } else if (body.roof == RoofKind::kGabled) {
    slopes = GabledSlopes(body, out, out, out);
  } else if (body.roof == RoofKind::kHipped) {
    slopes = HippedSlopes(body, out);
  } else {
    slopes = MonoSlope(body, out);
  }
  for (const Corners3& slope : slopes) AddSlab(body, slope, out > 0, faces);
}

void AddDormer(const Body& main,
               const Dormer& dormer,
               const std::string& name,
               const BuildingDetail& detail,
               FaceList& faces) {
  const double x0 = dormer.center_x - dormer.width / 2;
  const double x1 = dormer.center_x + dormer.width / 2;
  const double xm = dormer.center_x;
  const double y = dormer.front_y;
  const double foot = StreetSlopeAt(main, y);
  // Where the slope is as high as the dormer's eaves and ridge.
  const double steepness = StreetSlopeAt(main, 1) - StreetSlopeAt(main, 0);
  const double y_eaves = y + (dormer.eaves - foot) / steepness;
  const double y_ridge = y + (dormer.ridge - foot) / steepness;
  WallPiece front;
  front.from = {x0, y};
  front.to = {x1, y};
  front.low = foot;
  front.high_from = front.high_to = dormer.eaves;
  front.apex = dormer.ridge;
  Opening window;
  window.start_s = 0.9;
  window.end_s = dormer.width - 0.9;
  window.low_z = foot + 1;
  window.high_z = dormer.eaves - 0.1;
  window.num_panes = 2;
  Body wall = main;
  wall.material = Material::kPlain;
  wall.color = {0.5f, 0.48f, 0.43f};
  wall.has_plinth = false;
  wall.course_heights.clear();
  wall.cornice = 0;
  AddWallPiece(wall, front, {window}, detail, name + " front", faces);
  faces.Add({{x1, y, foot}, {x1, y_eaves, dormer.eaves}, {x1, y, dormer.eaves}},
            name + " right cheek",
            Material::kSlate,
            main.roof_color);
  faces.Add({{x0, y, foot}, {x0, y, dormer.eaves}, {x0, y_eaves, dormer.eaves}},
            name + " left cheek",
            Material::kSlate,
            main.roof_color);
  faces.Add({{x1, y, dormer.eaves},
             {x1, y_eaves, dormer.eaves},
             {xm, y_ridge, dormer.ridge},
             {xm, y, dormer.ridge}},
            name + " right slope",
            main.roof_material,
            main.roof_color);
  faces.Add({{x0, y_eaves, dormer.eaves},
             {x0, y, dormer.eaves},
             {xm, y, dormer.ridge},
             {xm, y_ridge, dormer.ridge}},
            name + " left slope",
            main.roof_material,
            main.roof_color);
}

}  // namespace groundglass
