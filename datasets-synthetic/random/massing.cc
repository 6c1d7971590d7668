// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/massing.h"

#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/occluder_shapes.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

std::vector<PlanCorner> PlanOf(const std::vector<Eigen::Vector2d>& points) {
  std::vector<PlanCorner> corners;
  for (const Eigen::Vector2d& point : points) corners.push_back({point, 0, true, {}});
  return corners;
}

std::vector<PlanCorner> RectanglePlan(double low_x, double low_y, double high_x, double high_y) {
  return PlanOf({{low_x, low_y}, {high_x, low_y}, {high_x, high_y}, {low_x, high_y}});
}

double ToQuarter(double length) { return std::round(4 * length) / 4; }

void Paint(const std::string& cladding, Draws& draws, Body& body) {
  const double chance = draws.Uniform(0, 1);
  const auto shade = static_cast<float>(draws.Uniform(0.8, 1.2));
  const auto pick = [&](const std::vector<Rgb>& colors) {
    return Rgb(colors[static_cast<size_t>(chance * static_cast<double>(colors.size()))] * shade);
  };
  if (cladding == "brick") {
    body.material = Material::kBrick;
    body.color = pick({{0.33f, 0.12f, 0.075f}, {0.27f, 0.13f, 0.09f}, {0.42f, 0.31f, 0.17f}});
  } else if (cladding == "stone") {
    body.material = Material::kStone;
    body.color = pick({{0.46f, 0.41f, 0.31f}, {0.35f, 0.34f, 0.32f}, {0.4f, 0.27f, 0.2f}});
  } else if (cladding == "plaster") {
    body.material = Material::kPlaster;
    body.color = pick({{0.6f, 0.58f, 0.52f},
                       {0.56f, 0.45f, 0.25f},
                       {0.45f, 0.3f, 0.24f},
                       {0.38f, 0.43f, 0.4f},
                       {0.5f, 0.5f, 0.5f}});
  } else if (cladding == "tile") {
    body.material = Material::kTile;
    body.color = pick({{0.66f, 0.66f, 0.64f}, {0.45f, 0.5f, 0.48f}});
  } else {
    body.material = Material::kConcrete;
    body.color = pick({{0.4f, 0.39f, 0.37f}, {0.3f, 0.3f, 0.3f}});
  }
}

void PaintRoof(const RandomTraits& traits, Draws& draws, Body& body) {
  const double chance = draws.Uniform(0, 1);
  if (traits.roof == "flat") {
    body.roof_material = Material::kRoof;
    body.roof_color = Rgb(0.33f, 0.32f, 0.3f) * static_cast<float>(draws.Uniform(0.6, 1.1));
    return;
  }
  body.roof_material = Material::kSlate;
  body.roof_color = chance < 0.5 ? Rgb(0.13f, 0.14f, 0.16f) : Rgb(0.3f, 0.11f, 0.07f);
}

RoofKind KindOf(const std::string& roof) {
  if (roof == "gabled") return RoofKind::kGabled;
  if (roof == "hipped") return RoofKind::kHipped;
  return roof == "mono" ? RoofKind::kMono : RoofKind::kFlat;
}

// Plans of one flat-roofed body.
std::vector<PlanCorner> FlatPlan(const RandomTraits& traits, Draws& draws) {
  const double w = traits.width;
  const double d = traits.depth;
  const double across = ToQuarter(w * draws.Uniform(0.3, 0.45));
  const double deep = ToQuarter(d * draws.Uniform(0.4, 0.6));
  const bool is_mirrored = draws.Chance(0.5);
  const bool opens_to_street = draws.Chance(0.5);
  std::vector<Eigen::Vector2d> points = {{0, 0}, {w, 0}, {w, d}, {0, d}};
  if (traits.plan == "L") {
    points = {{0, 0}, {w, 0}, {w, deep}, {across, deep}, {across, d}, {0, d}};
  } else if (traits.plan == "T") {
    const double low = ToQuarter((w - across) * draws.Uniform(0.3, 0.7));
    const double high = low + across;
    points = {{0, 0}, {w, 0}, {w, deep}, {high, deep}, {high, d}, {low, d}, {low, deep}, {0, deep}};
  } else if (traits.plan == "U") {
    const double wing = ToQuarter(w * draws.Uniform(0.24, 0.32));
    points = {
        {0, 0}, {w, 0}, {w, d}, {w - wing, d}, {w - wing, deep}, {wing, deep}, {wing, d}, {0, d}};
  }
  // Turned about, so that what was at the back is at the street.
  if (opens_to_street && points.size() > 4) {
    for (Eigen::Vector2d& point : points) point = Eigen::Vector2d(w, d) - point;
  }
  if (is_mirrored && points.size() > 4) {
    for (Eigen::Vector2d& point : points) point.x() = w - point.x();
    std::reverse(points.begin(), points.end());
  }
  return PlanOf(points);
}

// Rounds the corners that stand out towards the street.
void RoundStreetCorners(double radius, Body& body) {
  if (radius == 0) return;
  const size_t n = body.plan.size();
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d in = body.plan[i].at - body.plan[(i + n - 1) % n].at;
    const Eigen::Vector2d out = body.plan[(i + 1) % n].at - body.plan[i].at;
    const bool stands_out = in.x() * out.y() - in.y() * out.x() > 0;
    if (!stands_out || body.plan[i].at.y() > body.Low().y() + 1) continue;
    if (std::min(in.norm(), out.norm()) < 2 * radius + 6) continue;
    body.plan[i].radius = radius;
  }
}

// Upper storeys that stand back on all sides.
void AddSetbacks(const RandomTraits& traits, Draws& draws, Massing& massing) {
  for (int i = 0; i < traits.setbacks; ++i) {
    const Body lower = massing.bodies.back();
    if (lower.plan.size() != 4) return;
    const Eigen::Vector2d size = lower.High() - lower.Low();
    const double back = ToQuarter(draws.Uniform(4, 0.22 * size.minCoeff() + 4));
    if (size.minCoeff() - 2 * back < 16) return;
    Body upper = lower;
    upper.name = "upper block " + std::to_string(i + 1);
    upper.plan = RectanglePlan(lower.Low().x() + back,
                               lower.Low().y() + back,
                               lower.High().x() - ToQuarter(back * draws.Uniform(0.8, 1.6)),
                               lower.High().y() - back);
    upper.base = lower.eaves;
    const int storeys = 1 + static_cast<int>(draws.Uniform(0, 2));
    upper.eaves = upper.base + storeys * traits.storey_height + 1;
    upper.has_plinth = false;
    if (draws.Chance(0.3)) Paint("plaster", draws, upper);
    massing.bodies.push_back(upper);
  }
}

// A wing before the street's wall of the first body or behind its back, under a roof that runs into
// the first body's, or lower and flat or under a roof of its own.
void AddPitchedWing(const RandomTraits& traits,
                    double low_x,
                    double wing_width,
                    double length,
                    bool at_street,
                    Massing& massing) {
  const Body main = massing.bodies.front();
  Body wing = main;
  wing.name = (at_street ? "front wing " : "back wing ") + std::to_string(massing.bodies.size());
  wing.is_ridge_along_x = false;
  const double y = at_street ? main.Low().y() : main.High().y();
  if (at_street) {
    wing.plan = RectanglePlan(low_x, y - length, low_x + wing_width, y);
    wing.plan[2].has_wall = false;
  } else {
    wing.plan = RectanglePlan(low_x, y, low_x + wing_width, y + length);
    wing.plan[0].has_wall = false;
  }
  if (traits.roof == "mono") {
    // Lower, and leant against the wall.
    wing.is_ridge_along_x = true;
    wing.eaves = main.eaves - 4;
    wing.ridge = at_street ? wing.eaves + 0.1 * length : wing.eaves;
    wing.roof = at_street ? RoofKind::kMono : RoofKind::kFlat;
    wing.parapet = 0;
    wing.overhang = 0;
  } else {
    wing.ridge = main.eaves + traits.pitch * wing_width / 2;
    wing.runs_into = 0;
  }
  massing.bodies.push_back(wing);
}

void AddPitchedWings(const RandomTraits& traits, Draws& draws, Massing& massing) {
  const double w = traits.width;
  const double d = traits.depth;
  // So wide that its ridge stays below the first body's, and within a hipped roof's middle part.
  const double widest = std::min(0.8 * d, 0.42 * w);
  const double width = ToQuarter(draws.Uniform(0.65, 1) * widest);
  const double margin = traits.roof == "hipped" ? ToQuarter(0.4 * d) : 3.5;
  const double length = ToQuarter(draws.Uniform(9, 26));
  const bool at_street = draws.Chance(0.65);
  const bool at_left = draws.Chance(0.5);
  const double left = margin;
  const double right = w - margin - width;
  if (right < left) return;
  const auto add = [&](double low_x, double reach, bool front) {
    AddPitchedWing(traits, low_x, width, reach, front, massing);
  };
  if (traits.plan == "L") add(at_left ? left : right, length, at_street);
  if (traits.plan == "T") add(ToQuarter((left + right) / 2), length, at_street);
  if (traits.plan == "wings") {
    add(ToQuarter(std::lerp(left, right, draws.Uniform(0, 1))), length, true);
    add(ToQuarter(std::lerp(left, right, draws.Uniform(0, 1))), ToQuarter(0.7 * length), false);
  }
  if (traits.plan == "U" && right - left > width + 6) {
    add(left, length, at_street);
    add(right, length, at_street);
  }
}

// Lower or higher blocks beside the first one, each with a flat roof.
void AddFlatWings(const RandomTraits& traits, Draws& draws, Massing& massing) {
  const Body main = massing.bodies.front();
  const int num_wings = 1 + static_cast<int>(draws.Uniform(0, 2));
  for (int i = 0; i < num_wings; ++i) {
    Body wing = main;
    wing.name = i == 0 ? "west wing" : "east wing";
    const double length = ToQuarter(draws.Uniform(16, 40));
    const double front = ToQuarter(draws.Uniform(2, 0.25 * traits.depth));
    const double back = traits.depth - ToQuarter(draws.Uniform(2, 0.25 * traits.depth));
    if (i == 0) {
      wing.plan = RectanglePlan(-length, front, 0, back);
      wing.plan[1].has_wall = false;
    } else {
      wing.plan = RectanglePlan(traits.width, front, traits.width + length, back);
      wing.plan[3].has_wall = false;
    }
    const int storeys = std::max(1, traits.storeys - 1 - static_cast<int>(draws.Uniform(0, 2)));
    wing.eaves = std::min(storeys * traits.storey_height + 1.5, main.eaves - 3);
    if (draws.Chance(0.35)) Paint(draws.Chance(0.5) ? "plaster" : "brick", draws, wing);
    massing.bodies.push_back(wing);
  }
}

// A square tower that stands out of the first body's front.
void AddTower(const RandomTraits& traits, Draws& draws, Massing& massing) {
  const Body main = massing.bodies.front();
  Body tower = main;
  tower.name = "tower";
  const double side = ToQuarter(draws.Uniform(14, std::min(24.0, 0.45 * traits.width)));
  const double out = ToQuarter(draws.Uniform(2, 5));
  const double low_x =
      draws.Chance(0.5) ? -out : ToQuarter((traits.width - side) * draws.Uniform(0.3, 0.7));
  tower.plan = RectanglePlan(low_x, -out, low_x + side, side - out);
  const double top = std::max(main.Top(), main.eaves);
  tower.eaves = ToQuarter(top + draws.Uniform(6, 24));
  tower.is_ridge_along_x = true;
  tower.overhang = main.overhang / 2;
  if (traits.roof != "flat" && draws.Chance(0.75)) {
    tower.roof = RoofKind::kHipped;
    tower.ridge = tower.eaves + side / 2 * draws.Uniform(0.6, 2.2);
  } else {
    tower.roof = RoofKind::kFlat;
    tower.parapet = 2;
    tower.overhang = 0;
    tower.ridge = tower.eaves;
  }
  tower.course_heights = {main.eaves, tower.eaves - 2};
  massing.bodies.push_back(tower);
}

void AddChimneys(const RandomTraits& traits, Draws& draws, Massing& massing) {
  const Body& main = massing.bodies.front();
  for (int i = 0; i < traits.chimneys; ++i) {
    PlainBox chimney;
    chimney.kind = "chimneys";
    chimney.name = "chimney " + std::to_string(i + 1);
    const double x = traits.width * (i == 0 ? draws.Uniform(0.15, 0.4) : draws.Uniform(0.6, 0.85));
    const double y = traits.depth * draws.Uniform(0.35, 0.7);
    const double width = draws.Uniform(2.5, 4.5);
    chimney.low = {x, y, main.eaves + 0.5};
    chimney.high = {x + width, y + draws.Uniform(2, 3), main.ridge + draws.Uniform(2.5, 6)};
    chimney.material = Material::kBrick;
    chimney.color = Rgb(0.28f, 0.12f, 0.08f);
    massing.boxes.push_back(chimney);
  }
}

void AddDormers(const RandomTraits& traits, Draws& draws, Massing& massing) {
  const Body& main = massing.bodies.front();
  const double rise = main.ridge - main.eaves;
  if (traits.dormers == 0 || rise < 9) return;
  Dormer dormer;
  dormer.width = draws.Uniform(5, 7);
  dormer.front_y = 0.14 * traits.depth;
  const double sill = StreetSlopeAt(main, dormer.front_y);
  dormer.eaves = sill + std::min(5.0, 0.42 * rise);
  dormer.ridge = std::min(dormer.eaves + 0.5 * dormer.width, main.ridge - 1);
  const double inset = main.roof == RoofKind::kHipped ? 0.45 * traits.depth : 5;
  for (int i = 0; i < traits.dormers; ++i) {
    dormer.center_x = std::lerp(inset + dormer.width / 2,
                                traits.width - inset - dormer.width / 2,
                                (i + 0.5) / traits.dormers);
    bool is_free = true;
    for (size_t k = 1; k < massing.bodies.size(); ++k) {
      const Body& other = massing.bodies[k];
      is_free &= dormer.center_x + dormer.width / 2 + 2 < other.Low().x() ||
                 dormer.center_x - dormer.width / 2 - 2 > other.High().x() ||
                 other.Low().y() > dormer.front_y;
    }
    if (is_free) massing.dormers.push_back(dormer);
  }
}

// One beside the other along the street, each a house of its own.
void AddNeighbours(const RandomTraits& traits, Draws& draws, Massing& massing) {
  double low_x = 0;
  double high_x = 0;
  for (const Body& body : massing.bodies) {
    low_x = std::min(low_x, body.Low().x() - body.overhang);
    high_x = std::max(high_x, body.High().x() + body.overhang);
  }
  const bool abuts = traits.roof == "flat" && draws.Chance(0.4);
  const auto add_row = [&](double edge, double direction, const std::string& side) {
    const int count = 1 + static_cast<int>(draws.Uniform(0, 2));
    for (int i = 0; i < count; ++i) {
      Body house;
      house.name = side + " neighbour " + std::to_string(i + 1);
      house.is_neighbour = true;
      const double gap = abuts && i == 0 ? 0 : ToQuarter(draws.Uniform(6, 16));
      const double width = ToQuarter(draws.Uniform(26, 55));
      const double depth = ToQuarter(draws.Uniform(26, 45));
      const double front = ToQuarter(draws.Uniform(-1, 4));
      const double from = edge + direction * gap;
      const double to = from + direction * width;
      house.plan = RectanglePlan(std::min(from, to), front, std::max(from, to), front + depth);
      house.eaves = 10.5 * (1 + static_cast<int>(draws.Uniform(1, 4.5))) + 1;
      house.roof = draws.Chance(0.5) ? RoofKind::kFlat : RoofKind::kGabled;
      house.parapet = 2;
      house.ridge = house.eaves + depth / 2 * 0.7;
      if (house.roof == RoofKind::kGabled && gap > 0) house.overhang = 1;
      const char* claddings[3] = {"brick", "plaster", "stone"};
      Paint(claddings[static_cast<int>(draws.Uniform(0, 3))], draws, house);
      if (house.roof == RoofKind::kGabled) {
        house.roof_material = Material::kSlate;
        house.roof_color = {0.2f, 0.13f, 0.11f};
      }
      massing.bodies.push_back(house);
      edge = to;
    }
  };
  if (traits.neighbours == "left" || traits.neighbours == "both") add_row(low_x, -1, "west");
  if (traits.neighbours == "right" || traits.neighbours == "both") add_row(high_x, 1, "east");
}

}  // namespace

Eigen::Vector2d Body::Low() const {
  Eigen::Vector2d low = plan.front().at;
  for (const PlanCorner& corner : plan) low = low.cwiseMin(corner.at);
  return low;
}

Eigen::Vector2d Body::High() const {
  Eigen::Vector2d high = plan.front().at;
  for (const PlanCorner& corner : plan) high = high.cwiseMax(corner.at);
  return high;
}

double StreetSlopeAt(const Body& body, double y) {
  const double half = (body.High().y() - body.Low().y()) / 2;
  return body.eaves + (body.ridge - body.eaves) / half * (y - body.Low().y());
}

Massing DrawMassing(const RandomTraits& traits, uint64_t seed) {
  Draws draws(SeedFor(seed, "random massing"));
  Massing massing;
  Body main;
  main.name = "main block";
  main.roof = KindOf(traits.roof);
  const bool is_flat = main.roof == RoofKind::kFlat;
  main.plan = is_flat ? FlatPlan(traits, draws) : RectanglePlan(0, 0, traits.width, traits.depth);
  if (traits.plan == "courtyard") {
    const double ring = ToQuarter(std::min(traits.width, traits.depth) * draws.Uniform(0.26, 0.32));
    main.court = RectanglePlan(ring, ring, traits.width - ring, traits.depth - ring);
    std::reverse(main.court.begin(), main.court.end());
  }
  main.eaves = traits.storeys * traits.storey_height + 2;
  main.ridge = main.eaves;
  if (main.roof == RoofKind::kMono) main.ridge += traits.pitch * traits.depth;
  if (main.roof == RoofKind::kGabled || main.roof == RoofKind::kHipped) {
    main.ridge += traits.pitch * traits.depth / 2;
  }
  main.parapet = is_flat ? traits.parapet : 0;
  main.overhang = is_flat ? 0 : traits.overhang;
  main.cornice = traits.cornice;
  main.has_plinth = traits.has_plinth;
  if (traits.has_courses) main.course_heights = {traits.storey_height + 1};
  Paint(traits.cladding, draws, main);
  PaintRoof(traits, draws, main);
  RoundStreetCorners(traits.corner_radius, main);
  massing.bodies.push_back(main);
  if (is_flat) {
    if (traits.plan == "wings") AddFlatWings(traits, draws, massing);
    if (traits.plan == "rectangle") AddSetbacks(traits, draws, massing);
  } else {
    AddPitchedWings(traits, draws, massing);
  }
  if (traits.plan == "tower") AddTower(traits, draws, massing);
  if (main.roof == RoofKind::kGabled || main.roof == RoofKind::kHipped) {
    AddChimneys(traits, draws, massing);
    AddDormers(traits, draws, massing);
  }
  AddNeighbours(traits, draws, massing);
  return massing;
}

}  // namespace groundglass
