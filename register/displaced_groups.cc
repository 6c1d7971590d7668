// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/displaced_groups.h"

#include "register/fill_registration.h"
#include "scene/face_number.h"
#include "scene/length_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace groundglass {
namespace {

// What photographs say for the offset of a set at which they say most.
struct Suspicion {
  int set = -1;
  double offset_sigmas = 0;
  double nats = 0;
};

// Each photograph's say is limited, so that not one of them decides.
Suspicion SumProfiles(int set,
                      const std::vector<const GroupProfile*>& profiles,
                      const DisplacedGroupOptions& options) {
  Suspicion most{set, 0, 0};
  const size_t zero = profiles.front()->gain_nats.size() / 2;
  for (size_t entry = 0; entry < profiles.front()->gain_nats.size(); ++entry) {
    const double offset_sigmas = OffsetSigmas(entry, options.profile);
    double sum = 0;
    for (const GroupProfile* profile : profiles) {
      sum += std::clamp(profile->gain_nats[entry] - profile->gain_nats[zero],
                        -options.most_nats_of_photograph,
                        options.most_nats_of_photograph);
    }
    if (sum > most.nats) most = {set, offset_sigmas, sum};
  }
  return most;
}

// The suspicions that are worth a trial, the strongest first; without sets that were tried.
std::vector<Suspicion> FindSuspicions(const std::vector<PhotographAlignment>& alignments,
                                      const std::set<int>& tried,
                                      const DisplacedGroupOptions& options) {
  std::map<int, std::vector<const GroupProfile*>> profiles_of_set;
  for (const PhotographAlignment& alignment : alignments) {
    for (const GroupProfile& profile : alignment.group_profiles) {
      profiles_of_set[profile.set].push_back(&profile);
    }
  }
  std::vector<Suspicion> suspicions;
  for (const auto& [set, profiles] : profiles_of_set) {
    if (tried.count(set) > 0) continue;
    if (static_cast<int>(profiles.size()) < options.least_photographs) continue;
    const Suspicion found = SumProfiles(set, profiles, options);
    if (std::abs(found.offset_sigmas) < options.least_offset_sigmas) continue;
    if (found.nats >= options.least_suspicion_nats) suspicions.push_back(found);
  }
  std::stable_sort(suspicions.begin(), suspicions.end(), [](const auto& a, const auto& b) {
    return a.nats > b.nats;
  });
  return suspicions;
}

// edge_model with a set of groups moved further.
void MoveSet(int set, double offset_units, EdgeModel& edge_model) {
  const EdgeGroups& groups = edge_model.groups;
  const EdgeGroupSet& moved = groups.sets[set];
  edge_model.group_offsets.resize(groups.num_numbers.size(), Eigen::Vector2d::Zero());
  for (size_t i = 0; i < moved.groups.size(); ++i) {
    edge_model.group_offsets[moved.groups[i]][moved.number] += offset_units * moved.factors[i];
  }
}

// What all photographs say for the second alignment over the first, each within limits.
DisplacedGroup Compare(DisplacedGroup displaced,
                       const std::vector<PhotographAlignment>& first,
                       const std::vector<PhotographAlignment>& second,
                       const DisplacedGroupOptions& options) {
  for (size_t i = 0; i < first.size(); ++i) {
    // One that neither way is a photograph of this building has no say.
    if (!HasCorrection(first[i].registration.verdict) &&
        !HasCorrection(second[i].registration.verdict)) {
      continue;
    }
    const double gain_nats = second[i].total_nats - first[i].total_nats;
    displaced.gain_nats +=
        std::clamp(gain_nats, -options.most_nats_of_photograph, options.most_nats_of_photograph);
    if (gain_nats >= options.least_nats_of_photograph) ++displaced.num_photographs;
  }
  return displaced;
}

// How often the photographs ask for each of the model's edges.
std::vector<double> CountSamples(const std::vector<PhotographAlignment>& alignments,
                                 size_t num_edges) {
  std::vector<double> counts(num_edges, 0);
  for (const PhotographAlignment& alignment : alignments) {
    for (const CandidateSample& found : alignment.aligned.found) ++counts[found.sample.edge];
  }
  return counts;
}

// A set that may be the misplaced one instead, and whether its planes' normals are those of the
// other's turned round.
struct Counterpart {
  int set = -1;
  bool is_turned = false;
};

// Of the sets that are parallel to an upright one and have no plane in common with it, the one that
// photographs show most of; none if there is none.
std::optional<Counterpart> FindCounterpart(int set,
                                           const EdgeGroups& groups,
                                           const std::vector<PhotographAlignment>& alignments) {
  const EdgeGroupSet& moved = groups.sets[set];
  if (moved.across_in_world.isZero()) return std::nullopt;
  const std::vector<double> counts = CountSamples(alignments, groups.of_edge.size());
  std::optional<Counterpart> counterpart;
  double most = 0;
  for (size_t other = 0; other < groups.sets.size(); ++other) {
    const EdgeGroupSet& still = groups.sets[other];
    const double cosine = still.across_in_world.dot(moved.across_in_world);
    if (std::abs(cosine) < kParallelCosine) continue;
    const bool is_apart = std::none_of(still.groups.begin(), still.groups.end(), [&](int group) {
      return std::find(moved.groups.begin(), moved.groups.end(), group) != moved.groups.end();
    });
    if (!is_apart) continue;
    const auto moves = MovesOfSet(still, groups);
    double shown = 0;
    for (size_t edge = 0; edge < moves.size(); ++edge) {
      if (moves[edge]) shown += counts[edge];
    }
    if (shown <= most) continue;
    most = shown;
    counterpart = {static_cast<int>(other), cosine < 0};
  }
  return counterpart;
}

// Either of two parts may be the misplaced one: what is claimed for each camera covers the one that
// it has if it is the other. share: how likely that is.
void CoverOtherWay(const std::vector<PhotographAlignment>& other_way,
                   double share,
                   std::vector<PhotographAlignment>& alignments) {
  for (size_t i = 0; i < alignments.size(); ++i) {
    AlignedPhotograph& here = alignments[i].aligned;
    const AlignedPhotograph& there = other_way[i].aligned;
    if (here.found.empty() || there.found.empty()) continue;
    CameraParameters apart =
        there.prior.ParametersAt(there.whitened) - here.prior.ParametersAt(here.whitened);
    apart[kYaw] = std::remainder(apart[kYaw], 360.0);
    here.doubt += share * apart * apart.transpose();
  }
}

// Where a set goes as a whole, unit length; an edge of two planes goes where both go.
Eigen::Vector3d DirectionOf(const EdgeGroupSet& set, const EdgeGroups& groups) {
  if (!set.across_in_world.isZero()) return set.across_in_world;
  const bool is_drawn_onto_a_plane = groups.num_numbers[set.groups.front()] == 2;
  if (!is_drawn_onto_a_plane) return Eigen::Vector3d::UnitZ();
  for (const auto& move : MovesOfSet(set, groups)) {
    if (move) return *move;
  }
  return Eigen::Vector3d::Zero();
}

// "0.95 ft further north and 0.2 ft higher": without what is a tenth of it or less.
std::string DescribeMove(const Eigen::Vector3d& move_in_world, LengthUnit unit) {
  constexpr std::array<std::array<const char*, 2>, 3> kWords = {
      {{"further west", "further east"}, {"further south", "further north"}, {"lower", "higher"}}};
  std::string words;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = std::abs(move_in_world[axis]);
    if (length <= 0.1 * move_in_world.norm()) continue;
    if (!words.empty()) words += " and ";
    words += fmt::format(
        "{:.2f} {} {}", length, UnitName(unit), kWords[axis][move_in_world[axis] > 0 ? 1 : 0]);
  }
  return words;
}

bool IsEnough(const DisplacedGroup& displaced, const DisplacedGroupOptions& options) {
  return displaced.gain_nats >= options.least_gain_nats &&
         displaced.num_photographs >= options.least_photographs;
}

// A set that is moved once more is told once.
void AddTo(std::vector<DisplacedGroup>& displaced, const DisplacedGroup& found) {
  for (DisplacedGroup& known : displaced) {
    if (known.set != found.set) continue;
    known.offset_units += found.offset_units;
    known.gain_nats += found.gain_nats;
    known.num_photographs = std::max(known.num_photographs, found.num_photographs);
    return;
  }
  displaced.push_back(found);
}

}  // namespace

std::vector<DisplacedGroup> FindDisplacedGroups(
    const DisplacedGroupOptions& options,
    const std::function<std::vector<PhotographAlignment>()>& align_all,
    EdgeModel& edge_model,
    std::vector<PhotographAlignment>& alignments) {
  std::vector<DisplacedGroup> displaced;
  std::set<int> tried;
  for (int trial = 0; trial < options.most_trials; ++trial) {
    const std::vector<Suspicion> suspicions = FindSuspicions(alignments, tried, options);
    if (suspicions.empty()) break;
    const Suspicion& suspicion = suspicions.front();
    const double offset_units = suspicion.offset_sigmas * edge_model.sigma;
    const std::vector<Eigen::Vector2d> before = edge_model.group_offsets;
    MoveSet(suspicion.set, offset_units, edge_model);
    std::vector<PhotographAlignment> moved = align_all();
    DisplacedGroup candidate =
        Compare({suspicion.set, offset_units, 0, 0}, alignments, moved, options);
    if (!IsEnough(candidate, options)) {
      tried.insert(suspicion.set);
      edge_model.group_offsets = before;
      continue;
    }
    // Two walls are too far apart or too near: which of them is in its place?
    if (const std::optional<Counterpart> counterpart =
            FindCounterpart(suspicion.set, edge_model.groups, moved)) {
      const std::vector<Eigen::Vector2d> one_way = edge_model.group_offsets;
      const double other_offset_units = counterpart->is_turned ? offset_units : -offset_units;
      edge_model.group_offsets = before;
      MoveSet(counterpart->set, other_offset_units, edge_model);
      std::vector<PhotographAlignment> other_way = align_all();
      const DisplacedGroup other =
          Compare({counterpart->set, other_offset_units, 0, 0}, alignments, other_way, options);
      const double lead_nats = candidate.gain_nats - other.gain_nats;
      if (lead_nats < 0 && IsEnough(other, options)) {
        candidate = other;
        std::swap(moved, other_way);
      } else {
        edge_model.group_offsets = one_way;
      }
      CoverOtherWay(
          other_way, 1 / (1 + std::exp(std::abs(lead_nats) / options.doubtful_nats)), moved);
    }
    // What was in doubt before still is.
    for (size_t i = 0; i < moved.size(); ++i) {
      moved[i].aligned.doubt += alignments[i].aligned.doubt;
    }
    AddTo(displaced, candidate);
    alignments = std::move(moved);
  }
  if (displaced.empty()) edge_model.group_offsets.clear();
  for (PhotographAlignment& alignment : alignments) {
    if (alignment.aligned.doubt.isZero()) continue;
    if (alignment.second_best) alignment.second_best->doubt = alignment.aligned.doubt;
    AddToCovariance(alignment.aligned.doubt,
                    alignment.aligned.prior,
                    alignment.aligned.whitened,
                    edge_model.model,
                    alignment.registration);
  }
  return displaced;
}

std::string DescribeDisplacedGroup(const DisplacedGroup& displaced, const EdgeModel& edge_model) {
  const EdgeGroupSet& set = edge_model.groups.sets[displaced.set];
  const auto moves = MovesOfSet(set, edge_model.groups);
  std::vector<std::string> names;
  for (size_t edge = 0; edge < moves.size(); ++edge) {
    if (!moves[edge]) continue;
    const std::string name = NameOfFace(edge_model.model, edge_model.edges[edge].first_face);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  constexpr size_t kMostNames = 3;
  std::string whose;
  for (size_t i = 0; i < names.size() && i < kMostNames; ++i) {
    whose += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kMostNames) whose += fmt::format(" and {} more", names.size() - kMostNames);
  return fmt::format(
      "the model seems to be off: {} photographs fit much better if edges of {} lie {} from where "
      "they are drawn, or what stands beside them as far the other way; they were taken to lie "
      "there. Measure that again, and correct the model",
      displaced.num_photographs,
      whose,
      DescribeMove(displaced.offset_units * DirectionOf(set, edge_model.groups),
                   edge_model.model.unit));
}

}  // namespace groundglass
