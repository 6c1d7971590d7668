// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/occluder_shapes.h"
#include "datasets-synthetic/random/massing.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// A part of a wall, along it and up.
struct WallRectangle {
  double start_s, end_s, low_z, high_z;
};

bool Overlaps(const WallRectangle& a, const WallRectangle& b) {
  return a.start_s < b.end_s && b.start_s < a.end_s && a.low_z < b.high_z && b.low_z < a.high_z;
}

// A wall as its windows see it.
struct WallSite {
  Eigen::Vector2d from, along;
  double length = 0;
  double start_s = 0;  // where it is flat and free of its own corners
  double end_s = 0;
  double low_z = 0;
  double high_z = 0;
  bool is_at_street = false;
  std::vector<WallRectangle> taken;  // by other bodies
};

// What another upright box takes of a wall: where it reaches into the space before it.
void TakeBehind(const Eigen::Vector2d& low,
                const Eigen::Vector2d& high,
                double base,
                double top,
                WallSite& site) {
  constexpr double kBefore = 2.5;  // feet before the wall
  constexpr double kBeside = 0.8;
  const Eigen::Vector2d outward(site.along.y(), -site.along.x());
  double low_s = 1e9, high_s = -1e9, low_n = 1e9, high_n = -1e9;
  for (const Eigen::Vector2d& corner :
       {low, high, Eigen::Vector2d(low.x(), high.y()), Eigen::Vector2d(high.x(), low.y())}) {
    const Eigen::Vector2d offset = corner - site.from;
    low_s = std::min(low_s, offset.dot(site.along));
    high_s = std::max(high_s, offset.dot(site.along));
    low_n = std::min(low_n, offset.dot(outward));
    high_n = std::max(high_n, offset.dot(outward));
  }
  if (high_n < 1e-6 || low_n > kBefore) return;
  site.taken.push_back({low_s - kBeside, high_s + kBeside, base - 0.5, top + 0.8});
}

WallSite SiteOfWall(const Massing& massing, size_t body_index, bool in_court, size_t edge) {
  const Body& body = massing.bodies[body_index];
  const std::vector<PlanCorner>& plan = in_court ? body.court : body.plan;
  const PlanCorner& corner = plan[edge];
  const PlanCorner& next = plan[(edge + 1) % plan.size()];
  WallSite site;
  site.from = corner.at;
  site.length = (next.at - corner.at).norm();
  site.along = (next.at - corner.at) / site.length;
  site.start_s = corner.radius + 1.3;
  site.end_s = site.length - next.radius - 1.3;
  site.low_z = body.base;
  site.high_z = body.eaves;
  site.is_at_street = !in_court && site.along.x() > 0.99 && corner.at.y() < 1e-6;
  for (size_t i = 0; i < massing.bodies.size(); ++i) {
    const Body& other = massing.bodies[i];
    if (i != body_index) TakeBehind(other.Low(), other.High(), other.base, other.Top(), site);
  }
  return site;
}

bool IsFree(const WallSite& site, const Opening& opening) {
  if (opening.start_s < site.start_s || opening.end_s > site.end_s) return false;
  if (opening.low_z < site.low_z || opening.high_z > site.high_z - 0.8) return false;
  const WallRectangle own{opening.start_s, opening.end_s, opening.low_z, opening.high_z};
  return std::none_of(site.taken.begin(), site.taken.end(), [&](const WallRectangle& taken) {
    return Overlaps(own, taken);
  });
}

// Adds an opening where there is room, and keeps others a foot away from it.
bool AddOpening(const Opening& opening, WallSite& site, std::vector<Opening>& openings) {
  if (!IsFree(site, opening)) return false;
  openings.push_back(opening);
  constexpr double kApart = 0.9;
  site.taken.push_back({opening.start_s - kApart,
                        opening.end_s + kApart,
                        opening.low_z - kApart,
                        opening.high_z + kApart});
  return true;
}

int PanesOf(double width) { return std::max(1, static_cast<int>(std::lround(width / 2.6))); }

// Windows of one storey in a row, `pitch` apart, `width` wide.
void AddRow(const RandomTraits& traits,
            double sill,
            double top,
            WallSite& site,
            std::vector<Opening>& openings) {
  const bool is_band = traits.windows == "bands";
  Opening window;
  window.low_z = sill;
  window.high_z = top;
  window.is_arched = traits.has_arches;
  if (is_band) {
    window.is_arched = false;
    // As long as there is room for, in pieces between what stands in the way.
    constexpr double kStep = 2;
    double start = site.start_s;
    while (start + 6 < site.end_s) {
      window.start_s = start;
      window.end_s = start + 5;
      if (!IsFree(site, window)) {
        start += kStep;
        continue;
      }
      const double longest = 40;
      while (window.end_s + kStep < std::min(site.end_s, start + longest)) {
        Opening longer = window;
        longer.end_s += kStep;
        if (!IsFree(site, longer)) break;
        window = longer;
      }
      window.num_panes = std::max(1, static_cast<int>(std::lround((window.end_s - start) / 5)));
      AddOpening(window, site, openings);
      start = window.end_s + 2;
    }
    return;
  }
  const double room = site.length - 2;
  const int count = static_cast<int>(room / traits.bay);
  const double pitch = count > 0 ? room / count : room;
  const bool is_pair = traits.windows == "pairs";
  const double width = std::min(traits.window_width, pitch - 2.2);
  if (width < 1.2) return;
  for (int i = 0; i < count; ++i) {
    const double middle = 1 + (i + 0.5) * pitch;
    for (int k = 0; k < (is_pair ? 2 : 1); ++k) {
      const double leaf = is_pair ? 0.46 * width : width;
      window.start_s =
          is_pair ? (k == 0 ? middle - 0.55 - leaf : middle + 0.55) : middle - width / 2;
      window.end_s = window.start_s + leaf;
      window.num_panes = PanesOf(leaf);
      AddOpening(window, site, openings);
    }
  }
}

void AddIrregular(const RandomTraits& traits,
                  double floor_z,
                  double share,
                  Draws& draws,
                  WallSite& site,
                  std::vector<Opening>& openings) {
  const int count = static_cast<int>(share * site.length / traits.bay + draws.Uniform(0, 1));
  for (int i = 0; i < count; ++i) {
    Opening window;
    const double width = traits.window_width * draws.Uniform(0.5, 1.8);
    const double height = traits.window_height * draws.Uniform(0.5, 1.25);
    window.start_s = draws.Uniform(site.start_s, std::max(site.start_s, site.end_s - width));
    window.end_s = window.start_s + width;
    window.low_z = floor_z + draws.Uniform(2, std::max(2.1, traits.storey_height - height - 1.5));
    window.high_z = window.low_z + height;
    window.is_arched = traits.has_arches && draws.Chance(0.5);
    window.num_panes = PanesOf(width);
    AddOpening(window, site, openings);
  }
}

void FillWall(const RandomTraits& traits,
              Draws& draws,
              bool is_neighbour,
              WallSite& site,
              std::vector<Opening>& openings) {
  const double chance = draws.Uniform(0, 1);
  if (site.end_s - site.start_s < 3) return;
  if (!site.is_at_street && !is_neighbour && chance < traits.blind_share) return;
  const double storey = is_neighbour ? 10.5 : traits.storey_height;
  for (double floor_z = site.low_z + (site.low_z < 1 ? 1 : 0); floor_z + storey < site.high_z + 2;
       floor_z += storey) {
    if (!is_neighbour && traits.windows == "irregular") {
      AddIrregular(traits, floor_z, 1, draws, site, openings);
    } else if (!is_neighbour && traits.windows == "single") {
      AddIrregular(traits, floor_z, 0.2, draws, site, openings);
    } else if (traits.cladding == "glass" && !is_neighbour) {
      AddRow(traits, floor_z + 1.2, floor_z + storey - 1.2, site, openings);
    } else {
      const double sill = floor_z + 0.28 * storey;
      AddRow(traits,
             sill,
             sill + traits.window_height * storey / traits.storey_height,
             site,
             openings);
    }
  }
}

// Steps of half a foot before a door, each a box within the one below it.
void AddSteps(const RandomTraits& traits, double half_width, double wall_y, Massing& massing) {
  for (int i = 0; i < traits.steps; ++i) {
    PlainBox step;
    step.kind = "steps";
    step.name = "step " + std::to_string(i + 1);
    const int from_top = traits.steps - i;
    const double half = half_width + 0.5 + 0.75 * from_top;
    step.low = {massing.door_x - half, wall_y - 1.5 - 1.05 * from_top, 0};
    step.high = {massing.door_x + half, wall_y + 0.2, 0.55 * (i + 1)};
    massing.boxes.push_back(step);
  }
}

void AddPorch(double half_width, double top, double wall_y, Massing& massing) {
  const double half = half_width + 2;
  const auto add =
      [&](const std::string& name, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
        massing.boxes.push_back({"porch", name, low, high, Material::kStone, {0.42f, 0.4f, 0.35f}});
      };
  const double x = massing.door_x;
  add("porch post west", {x - half, wall_y - 4.2, 0}, {x - half + 0.8, wall_y - 3.4, top});
  add("porch post east", {x + half - 0.8, wall_y - 4.2, 0}, {x + half, wall_y - 3.4, top});
  add("porch roof", {x - half - 0.5, wall_y - 4.7, top}, {x + half + 0.5, wall_y + 0.2, top + 1});
}

// The entrance: in the part of the street's side that has most room for it.
void AddEntrance(const RandomTraits& traits, Draws& draws, Massing& massing) {
  const double half_width = draws.Uniform(1.7, 3.5);
  const double height = std::min(draws.Uniform(7, 9.5), traits.storey_height - 1.6);
  const double where = draws.Uniform(0.25, 0.75);
  const double threshold = 0.55 * traits.steps;
  for (size_t i = 0; i < massing.bodies.size(); ++i) {
    Body& body = massing.bodies[i];
    if (body.is_neighbour || body.base > 0) continue;
    for (size_t edge = 0; edge < body.plan.size(); ++edge) {
      WallSite site = SiteOfWall(massing, i, false, edge);
      if (!body.plan[edge].has_wall || site.along.x() < 0.99) continue;
      // From the middle of the wall outwards.
      for (int attempt = 0; attempt < 9; ++attempt) {
        const double share = where + (attempt % 2 == 0 ? 1 : -1) * 0.05 * attempt;
        const double middle = std::lerp(site.start_s, site.end_s, std::clamp(share, 0.0, 1.0));
        Opening door{middle - half_width,
                     middle + half_width,
                     threshold,
                     threshold + height,
                     traits.has_arches,
                     true,
                     half_width > 2.4 ? 2 : 1};
        if (!IsFree(site, door)) continue;
        body.plan[edge].openings.push_back(door);
        massing.door_x = site.from.x() + middle;
        AddSteps(traits, half_width, site.from.y(), massing);
        if (traits.has_porch) {
          AddPorch(half_width + 0.75 * traits.steps, door.high_z + 0.8, site.from.y(), massing);
        }
        return;
      }
    }
  }
}

// No mason works to the hair: sides that would lie in one line do so to an eighth of an inch.
void SetByHand(Draws& draws, std::vector<Opening>& openings) {
  constexpr double kEighthInch = 0.01;
  for (Opening& opening : openings) {
    for (double* side : {&opening.start_s, &opening.end_s, &opening.low_z, &opening.high_z}) {
      const double off = draws.Uniform(-kEighthInch, kEighthInch);
      if (*side > 0.1) *side += off;
    }
  }
}

}  // namespace

void LayOutOpenings(const RandomTraits& traits, uint64_t seed, Massing& massing) {
  Draws draws(SeedFor(seed, "random openings"));
  AddEntrance(traits, draws, massing);
  RandomTraits of_neighbours = traits;
  of_neighbours.windows = "grid";
  of_neighbours.bay = 9;
  of_neighbours.window_width = 3.2;
  of_neighbours.window_height = 5;
  of_neighbours.storey_height = 10.5;
  of_neighbours.has_arches = false;
  for (size_t i = 0; i < massing.bodies.size(); ++i) {
    const bool is_neighbour = massing.bodies[i].is_neighbour;
    for (const bool in_court : {false, true}) {
      const size_t n = (in_court ? massing.bodies[i].court : massing.bodies[i].plan).size();
      for (size_t edge = 0; edge < n; ++edge) {
        WallSite site = SiteOfWall(massing, i, in_court, edge);
        PlanCorner& corner = (in_court ? massing.bodies[i].court : massing.bodies[i].plan)[edge];
        if (!corner.has_wall) continue;
        for (const Opening& door : corner.openings) {
          const double beside = traits.has_porch ? 4 : 1.2;
          site.taken.push_back(
              {door.start_s - beside, door.end_s + beside, door.low_z - 3, door.high_z + 2.2});
        }
        FillWall(is_neighbour ? of_neighbours : traits, draws, is_neighbour, site, corner.openings);
        SetByHand(draws, corner.openings);
      }
    }
  }
}

}  // namespace groundglass
