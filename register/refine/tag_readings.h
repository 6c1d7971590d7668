// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"
#include "register/edges/edge_evidence.h"
#include "register/edges/edge_samples.h"
#include "register/refine/find_solutions.h"
#include "scene/view_tag.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A notebook's standard deviations are guesses, and its numbers may hold a slip of the pen. Where
// the best camera that a tag allows is doubtful, the tag is read in other ways as well.
struct ReadingOptions {
  // Doubtful: the best solution scores less than this for each independent observation, or lies
  // further than this from the tag in one of its numbers, in sigmas.
  double doubt_below_nats_per_observation = 0.5;
  double doubt_beyond_sigmas = 3;
  // Then the standard deviations of position and direction are taken to be so many times larger
  // than claimed; 1: never. This share of all tags is expected to err so much.
  double wider_factor = 4;
  double wider_share = 0.03;
  // Of its solutions, so many that the tag as it is written allows too are followed there as well.
  int num_shared = 3;
  // Where even the best of these scores less than this for each observation, or in all, nats, the
  // tag is read as it may have been meant, and as another photograph's; this share of all tags is
  // expected to hold a slip. A glance, with a coarser search, tells which readings are worth a
  // whole one, and so many of them get it; 0: none.
  double slips_below_nats_per_observation = 0.15;
  double slips_below_nats = 45;
  double slip_share = 0.01;
  int num_slips = 3;
  int glance_grid_points = 1500;
  int glance_climbs = 3;

  // The more places are searched, the better is what chance finds: readings with larger errors are
  // believed only if they score so much, and slips if they do and lead by so much, nats.
  double min_wider_nats = 40;
  double min_slip_nats = 60;
  double min_slip_lead_nats = 20;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "reading options: ") const;
};

// One way to read a tag, and the cameras that fit it, best first, at least one.
struct TagReading {
  std::string slip;     // "x and y exchanged", "the tag of s7"; empty: as it is written
  double widening = 1;  // of the standard deviations that the tag claims for position and direction
  CameraPrior prior;
  double log_probability = 0;  // before the photograph is looked at, and per volume of the prior
  std::vector<Solution> solutions;

  double TotalScore() const { return solutions.front().TotalScore() + log_probability; }
};

// The tag of another photograph.
struct NamedTag {
  std::string name;
  ViewTag tag;
};

// The readings that were tried and have a solution, best first; empty if there is none. With
// control points only the one as it is written.
// written: the prior from the tag; prior_of: the same from another tag. points: in pixels of the
// prior's picture.
std::vector<TagReading> ReadTag(const EdgeModel& edge_model,
                                const EdgeEvidence& evidence,
                                const CameraPrior& written,
                                const std::function<CameraPrior(const ViewTag&)>& prior_of,
                                const std::vector<NamedTag>& other_tags,
                                const std::vector<ControlPoint>& points,
                                const SolutionOptions& solution_options,
                                const ReadingOptions& options);

// The best solution of all readings that lies elsewhere than the first's best, and in which reading
// it is; null if there is none. distance_px: in pixels of the prior's picture.
struct Rival {
  const TagReading* reading = nullptr;
  const Solution* solution = nullptr;
  double distance_px = 0;
  double total_score = 0;  // as the first reading's counts: without its log_probability
};
Rival FindRival(const std::vector<TagReading>& readings, const SolutionOptions& options);

}  // namespace groundglass
