// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine_set.h"

#include "register/judge_members.h"
#include "register/keep_joint.h"
#include "register/photograph_set.h"
#include "register/surveyed_tags_in_set.h"
#include "register/ties/find_ties.h"
#include "scene/error.h"
#include "scene/same_lens.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <utility>

namespace groundglass {
namespace {

std::vector<PhotographInSet> PlacesIn(const PhotographSet& set) {
  std::vector<PhotographInSet> places;
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    const Registration& registration = set.alignments[i]->registration;
    places.push_back({registration.name,
                      static_cast<double>(set.photographs[i].prior.width_px) /
                          std::max(1, registration.width_px)});
  }
  return places;
}

// Why what joint refinement took and gave could not be kept; empty if it was, or nobody asked.
std::string KeepJointIfAsked(const PhotographSet& set,
                             const std::vector<int>& lenses,
                             const TiePoints& ties,
                             const JointRefinement& joint,
                             const RegisterOptions& options) {
  if (options.keep_folder.empty()) return "";
  JointStage stage{{}, {}, set.photographs, lenses, ties.points, joint};
  for (const PhotographAlignment* alignment : set.alignments) {
    stage.names.push_back(alignment->registration.name);
    stage.widths_px.push_back(alignment->registration.width_px);
  }
  try {
    KeepJointStage(stage, options.keep_folder);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// The common solution of a set; its photographs' cameras are those found, afterwards.
JointRefinement Refine(const EdgeModel& edge_model,
                       const RegisterOptions& options,
                       const std::vector<SeenTagCorner>& tag_corners,
                       PhotographSet& set,
                       std::vector<MovedTag>& moved_tags) {
  std::vector<int> lenses;
  std::map<LensIdentity, int> lens_of_key;
  for (const PhotographAlignment* alignment : set.alignments) {
    const int next = static_cast<int>(lens_of_key.size());
    const Registration& registration = alignment->registration;
    const LensIdentity key =
        LensIdentityOf(registration.measured, registration.width_px, registration.height_px);
    lenses.push_back(lens_of_key.emplace(key, next).first->second);
  }
  JointOptions joint_options = options.joint;
  if (options.prior.digital) {
    // No mount and no scan gives a photograph a scale or a shift of its own.
    joint_options.own_view_angle_share = joint_options.own_k1_share;
    joint_options.own_aspect_share = joint_options.own_k1_share;
    joint_options.own_shift_share = joint_options.own_k1_share;
  }
  TiePoints ties;
  if (options.use_ties) {
    ties =
        FindTies(edge_model.model, edge_model.visibility, ViewsOf(set.photographs), options.ties);
  }
  const std::vector<PhotographInSet> places = PlacesIn(set);
  AddTagCorners(tag_corners, places, joint_options, ties.points);
  JointRefinement joint =
      options.refine_together(edge_model, set.photographs, lenses, ties.points, joint_options);
  for (const JointSolution& solution : joint.photographs) {
    if (!solution.whitened.allFinite() || !solution.covariance.allFinite()) {
      throw Error("register: the photographs' common solution has no covariance");
    }
  }
  moved_tags = FindMovedTags(ties.points, joint.tie_moves_in_world, places, joint_options);
  std::string& keep_fault = set.alignments.front()->keep_fault;
  if (keep_fault.empty()) keep_fault = KeepJointIfAsked(set, lenses, ties, joint, options);
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    set.photographs[i].whitened = joint.photographs[i].whitened;
  }
  set.edge_moves_in_world = joint.group_moves_in_world;
  return joint;
}

// Photographs that are not accepted by themselves join those that are where others show the same,
// each with the camera, its best or its second-best one, that edges and ties together speak for.
void JoinByTies(const EdgeModel& edge_model,
                const RegisterOptions& options,
                const std::vector<PhotographAlignment*>& barred,
                std::vector<PhotographAlignment>& alignments,
                PhotographSet& set) {
  struct Candidate {
    PhotographAlignment* alignment = nullptr;
    AlignedPhotograph photograph;
    bool joins = false;
  };
  std::vector<Candidate> candidates;
  std::vector<TieView> views = ViewsOf(set.photographs);
  const size_t num_members = views.size();
  for (PhotographAlignment& alignment : alignments) {
    if (alignment.registration.verdict != Verdict::kReview) continue;
    if (alignment.aligned.found.empty() || set.Holds(alignment)) continue;
    if (std::find(barred.begin(), barred.end(), &alignment) != barred.end()) continue;
    candidates.push_back({&alignment, alignment.aligned, false});
    views.push_back(ViewOf(alignment.aligned));
  }
  tbb::parallel_for(size_t{0}, candidates.size(), [&](size_t i) {
    Candidate& candidate = candidates[i];
    const std::optional<AlignedPhotograph>& second_best = candidate.alignment->second_best;
    TieSupport support =
        SupportFor(candidate.photograph, views, num_members + i, edge_model, options);
    if (second_best && !second_best->found.empty()) {
      const TieSupport others =
          SupportFor(*second_best, views, num_members + i, edge_model, options);
      const ScoreOptions& score = options.solutions.score;
      if (CountedLead(others, support, options.tie_support) >
          NatsAlone(candidate.photograph, edge_model, score) -
              NatsAlone(*second_best, edge_model, score)) {
        candidate.photograph = *second_best;
        support = others;
      }
    }
    candidate.joins = MayJoin(support, options.tie_support);
  });
  for (const Candidate& candidate : candidates) {
    if (!candidate.joins) continue;
    set.Add(*candidate.alignment,
            candidate.photograph,
            NatsAlone(candidate.photograph, edge_model, options.solutions.score));
  }
}

// Takes out the photograph of whose own edges the common solution explains the smallest share of
// what they do by themselves, if that is too little: others have pulled it away. Those that have
// only joined go first, and none comes back. Returns whether there was one.
bool TakeOutWorsened(const RegisterOptions& options,
                     PhotographSet& set,
                     std::vector<PhotographAlignment*>& barred) {
  std::optional<size_t> worst;
  std::pair<bool, double> worst_rank;  // accepted by itself, and share kept
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    const AlignmentScore score =
        ScoreOf(set.photographs[i], set.edge_moves_in_world, options.solutions.score);
    const double kept_nats = NatsFor(set.photographs[i], score);
    if (kept_nats >= options.tie_support.least_share_kept * set.alone[i].nats) continue;
    const std::pair rank(set.alignments[i]->registration.verdict == Verdict::kAccepted,
                         kept_nats / std::max(1e-9, set.alone[i].nats));
    if (worst && rank >= worst_rank) continue;
    worst = i;
    worst_rank = rank;
  }
  if (!worst) return false;
  barred.push_back(set.alignments[*worst]);
  set.TakeOut(*worst);
  return true;
}

}  // namespace

std::vector<EdgeDisplacement> RefineSet(const EdgeModel& edge_model,
                                        const RegisterOptions& options,
                                        std::vector<PhotographAlignment>& alignments,
                                        const std::vector<SeenTagCorner>& tag_corners,
                                        std::vector<MovedTag>* moved_tags) {
  PhotographSet set;
  set.edge_moves_in_world = edge_model.MovesInWorld();
  std::vector<MovedTag> moved;
  for (PhotographAlignment& alignment : alignments) {
    if (alignment.registration.verdict != Verdict::kAccepted) continue;
    if (alignment.aligned.found.empty()) continue;
    set.Add(alignment,
            alignment.aligned,
            NatsAlone(alignment.aligned, edge_model, options.solutions.score));
  }
  JointRefinement joint;
  std::vector<PhotographAlignment*> barred;
  // Cameras that know of one another show more alike, and more of what they show agrees.
  const int num_rounds = options.use_ties ? options.num_tie_rounds : 1;
  for (int round = 0; round < num_rounds; ++round) {
    if (options.use_ties) JoinByTies(edge_model, options, barred, alignments, set);
    if (set.photographs.size() < 2) return {};
    joint = Refine(edge_model, options, tag_corners, set, moved);
    while (TakeOutWorsened(options, set, barred)) {
      if (set.photographs.size() < 2) break;
      joint = Refine(edge_model, options, tag_corners, set, moved);
    }
  }
  for (PhotographAlignment* alignment : barred) {
    ApplyJudgement(JudgeDisagreement(), alignment->registration);
  }
  if (set.photographs.size() < 2) return {};
  if (moved_tags != nullptr) *moved_tags = std::move(moved);
  JudgeMembers(joint, edge_model, options, set);
  for (EdgeDisplacement& displacement : joint.displacements) {
    for (int& photograph : displacement.photographs) {
      photograph = static_cast<int>(set.alignments[photograph] - alignments.data());
    }
  }
  return joint.displacements;
}

}  // namespace groundglass
