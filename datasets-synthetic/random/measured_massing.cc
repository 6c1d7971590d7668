// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/measured_massing.h"

#include "datasets-synthetic/noise.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Errors of lengths: the same for the same length along the same axis.
class Measuring {
 public:
  Measuring(double sigma, uint64_t seed) : sigma_(sigma), seed_(seed) {}

  void AddFlaw(int axis, double value, double offset) { flaws_.push_back({axis, value, offset}); }

  double Along(int axis, double value) const {
    if (axis == 2 && value < 1e-6) return value;  // the ground is where it is
    double measured = value + Error("line", axis, value);
    for (const Flaw& flaw : flaws_) {
      if (flaw.axis == axis && std::abs(flaw.value - value) < 1e-6) measured += flaw.offset;
    }
    return measured;
  }
  Eigen::Vector2d OnPlan(const Eigen::Vector2d& at) const {
    return {Along(0, at.x()), Along(1, at.y())};
  }
  // Of a window's side, no more than it can bear.
  double Side(double value, uint64_t where) const {
    return value + 0.6 * Error("side", where, value);
  }

 private:
  struct Flaw {
    int axis;
    double value;
    double offset;
  };
  double Error(const char* what, uint64_t where, double value) const {
    const auto place = static_cast<uint64_t>(std::llround(1000 * value) + (1LL << 40));
    const double normal = NormalOf(HashOf(SeedFor(seed_, what, where), place));
    return sigma_ * std::clamp(normal, -2.5, 2.5);
  }

  double sigma_;
  uint64_t seed_;
  std::vector<Flaw> flaws_;
};

// Windows keep their places on the ground, whatever becomes of the corner that s counts from.
void MeasureOpenings(const std::vector<PlanCorner>& right,
                     const Measuring& measuring,
                     uint64_t wall,
                     std::vector<PlanCorner>& plan) {
  const size_t n = right.size();
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d along = (right[(i + 1) % n].at - right[i].at).normalized();
    const double shift = along.dot(plan[i].at - right[i].at);
    const double length = (plan[(i + 1) % n].at - plan[i].at).norm();
    for (Opening& opening : plan[i].openings) {
      const uint64_t row = 64 * wall + 2 * i;
      opening.start_s = std::max(0.3, measuring.Side(opening.start_s, row) - shift);
      opening.end_s = std::min(length - 0.3, measuring.Side(opening.end_s, row) - shift);
      if (opening.low_z > 1e-6) opening.low_z = measuring.Side(opening.low_z, row + 1);
      opening.high_z = measuring.Side(opening.high_z, row + 1);
    }
  }
}

void MeasureBody(const Measuring& measuring, uint64_t index, Body& body) {
  const Body right = body;
  for (std::vector<PlanCorner>* plan : {&body.plan, &body.court}) {
    for (PlanCorner& corner : *plan) corner.at = measuring.OnPlan(corner.at);
  }
  MeasureOpenings(right.plan, measuring, 2 * index, body.plan);
  MeasureOpenings(right.court, measuring, 2 * index + 1, body.court);
  body.base = measuring.Along(2, right.base);
  body.eaves = measuring.Along(2, right.eaves);
  // A parapet that is drawn at all is measured at its top.
  body.parapet = measuring.Along(2, right.eaves + right.parapet) - body.eaves;
  if (right.parapet == 0) body.parapet = 0;
  body.ridge = right.roof == RoofKind::kFlat ? body.eaves : measuring.Along(2, right.ridge);
}

// The windows of one wall, along it: of a wall that has some.
void ShiftWindows(const RandomTraits& traits,
                  uint64_t seed,
                  Massing& massing,
                  std::vector<ModelFlaw>& flaws) {
  Body& main = massing.bodies.front();
  const size_t n = main.plan.size();
  const size_t first = SeedFor(seed, "shifted wall") % n;
  for (size_t k = 0; k < n; ++k) {
    PlanCorner& corner = main.plan[(first + k) % n];
    if (corner.openings.size() < 2) continue;
    const double length = (main.plan[(first + k + 1) % n].at - corner.at).norm();
    for (const Opening& opening : corner.openings) {
      const double low = opening.start_s + traits.model.windows_off;
      const double high = opening.end_s + traits.model.windows_off;
      if (low < 0.2 || high > length - 0.2) return;
    }
    for (Opening& opening : corner.openings) {
      opening.start_s += traits.model.windows_off;
      opening.end_s += traits.model.windows_off;
    }
    flaws.push_back({"windows shifted",
                     "main block wall " + std::to_string((first + k) % n + 1),
                     traits.model.windows_off});
    return;
  }
}

bool IsOmitted(const RandomTraits& traits, const std::string& part) {
  return traits.model.omits.find(part) != std::string::npos;
}

void TellMissing(const Massing& massing,
                 const RandomTraits& traits,
                 std::vector<ModelFlaw>& flaws) {
  for (const PlainBox& box : massing.boxes) {
    if (IsOmitted(traits, box.kind)) flaws.push_back({"missing", box.name, 0});
  }
  if (!massing.dormers.empty() && IsOmitted(traits, "dormers")) {
    flaws.push_back({"missing", "dormers", 0});
  }
}

}  // namespace

Massing MeasureMassing(const Massing& massing,
                       const RandomTraits& traits,
                       uint64_t seed,
                       std::vector<ModelFlaw>& flaws) {
  Measuring measuring(traits.model.sigma, SeedFor(seed, "random measuring"));
  const Body& right = massing.bodies.front();
  if (traits.model.wall_off != 0) {
    const uint64_t side = SeedFor(seed, "wall off") % 3;
    const int axis = side == 0 ? 1 : 0;
    const double value = side == 0   ? right.Low().y()
                         : side == 1 ? right.Low().x()
                                     : right.High().x();
    measuring.AddFlaw(axis, value, traits.model.wall_off);
    const char* names[3] = {"at the street", "at the plan's low x", "at the plan's high x"};
    flaws.push_back({"wall off", std::string("main block, ") + names[side], traits.model.wall_off});
  }
  if (traits.model.eaves_off != 0) {
    measuring.AddFlaw(2, right.eaves, traits.model.eaves_off);
    if (right.parapet > 0) {
      measuring.AddFlaw(2, right.eaves + right.parapet, traits.model.eaves_off);
    }
    flaws.push_back({"eaves off", "main block", traits.model.eaves_off});
  }
  Massing measured = massing;
  for (size_t i = 0; i < measured.bodies.size(); ++i) {
    MeasureBody(measuring, i, measured.bodies[i]);
  }
  if (traits.model.windows_off != 0) ShiftWindows(traits, seed, measured, flaws);
  for (PlainBox& box : measured.boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = measuring.Along(axis, box.low[axis]);
      box.high[axis] = measuring.Along(axis, box.high[axis]);
    }
  }
  for (Dormer& dormer : measured.dormers) {
    dormer.center_x = measuring.Along(0, dormer.center_x);
    dormer.front_y = measuring.Along(1, dormer.front_y);
    dormer.eaves = measuring.Along(2, dormer.eaves);
    dormer.ridge = measuring.Along(2, dormer.ridge);
  }
  TellMissing(massing, traits, flaws);
  return measured;
}

BuildingDetail DetailOfWorld(const RandomTraits& traits, double relief) {
  BuildingDetail detail;
  detail.recess = traits.recess * relief;
  detail.has_sills = traits.has_sills;
  return detail;
}

BuildingDetail DetailOfModel(const RandomTraits& traits, double relief) {
  const RandomTraits::Model& model = traits.model;
  BuildingDetail detail = DetailOfWorld(traits, relief);
  detail.has_openings = model.detail != "massing";
  detail.has_mullions = model.detail == "mullions";
  const bool has_depth = model.detail == "recesses";
  if (!has_depth) detail.recess = 0;
  detail.has_ledges = has_depth;
  detail.has_sills = false;
  detail.has_parapets = model.has_parapet;
  detail.has_overhangs = model.has_overhang;
  detail.has_chimneys = !IsOmitted(traits, "chimneys");
  detail.has_dormers = !IsOmitted(traits, "dormers");
  detail.has_steps = !IsOmitted(traits, "steps");
  detail.has_porch = !IsOmitted(traits, "porch");
  detail.has_neighbours = model.has_neighbours;
  detail.neighbours_have_openings = false;
  detail.has_round_corners = false;
  return detail;
}

}  // namespace groundglass
