// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine_set.h"

#include "register/best_elsewhere.h"
#include "register/fill_registration.h"
#include "register/keep_joint.h"
#include "register/notebook_overclaim.h"
#include "register/shared_conflict.h"
#include "register/surveyed_tags_in_set.h"
#include "register/ties/find_ties.h"
#include "scene/error.h"
#include "scene/least_norm.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

namespace groundglass {
namespace {

// What photographs of the same lens have in common. Those of another shape are turned or cropped.
using LensKey = std::tuple<std::string, int, int, double, double>;

LensKey LensKeyOf(const Registration& registration) {
  const ViewTag& tag = registration.measured;
  const int shape = 1000 * registration.width_px / registration.height_px;
  if (!tag.camera.empty()) return {tag.camera, shape, 0, 0, 0};
  return {"", registration.width_px, registration.height_px, tag.view_angle_deg, tag.aspect};
}

// The photographs that are refined together.
struct PhotographSet {
  std::vector<PhotographAlignment*> alignments;
  std::vector<AlignedPhotograph> photographs;
  std::vector<CameraAlone> alone;  // the camera that each started with
  // How far the common solution has found groups of edges from where the model has them.
  std::vector<Eigen::Vector3d> edge_moves_in_world;

  bool Holds(const PhotographAlignment& alignment) const {
    return std::find(alignments.begin(), alignments.end(), &alignment) != alignments.end();
  }
  void Add(PhotographAlignment& alignment, const AlignedPhotograph& photograph, double nats) {
    alignments.push_back(&alignment);
    photographs.push_back(photograph);
    alone.push_back({photograph.whitened, nats});
  }
  void TakeOut(size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    alignments.erase(alignments.begin() + at);
    photographs.erase(photographs.begin() + at);
    alone.erase(alone.begin() + at);
  }
};

TieView ViewOf(const AlignedPhotograph& photograph) {
  return {photograph.picture.get(),
          photograph.prior.CameraAt(photograph.whitened),
          photograph.followed};
}

std::vector<TieView> ViewsOf(const std::vector<AlignedPhotograph>& photographs) {
  std::vector<TieView> views;
  for (const AlignedPhotograph& photograph : photographs) views.push_back(ViewOf(photograph));
  return views;
}

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
  std::map<LensKey, int> lens_of_key;
  for (const PhotographAlignment* alignment : set.alignments) {
    const int next = static_cast<int>(lens_of_key.size());
    lenses.push_back(lens_of_key.emplace(LensKeyOf(alignment->registration), next).first->second);
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

// How much other photographs speak for a camera; `skip`: the photograph's own place among them.
TieSupport SupportFor(const AlignedPhotograph& photograph,
                      const std::vector<TieView>& others,
                      std::optional<size_t> skip,
                      const EdgeModel& edge_model,
                      const RegisterOptions& options) {
  std::vector<TieView> views = {ViewOf(photograph)};
  for (size_t i = 0; i < others.size(); ++i) {
    if (i != skip) views.push_back(others[i]);
  }
  const TiePoints ties =
      FindTiesOf(0, edge_model.model, edge_model.visibility, views, options.ties);
  return MeasureTieSupport(0, ties, views, edge_model.sigma, options.tie_support);
}

// edge_moves_in_world: where the model's edges are taken to be (none: as they are drawn).
AlignmentScore ScoreOf(const AlignedPhotograph& photograph,
                       const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                       const ScoreOptions& options) {
  return ScoreFromSamples(WithEdgesMoved(photograph.score_samples, edge_moves_in_world),
                          photograph.prior.ProjectionAt(photograph.whitened),
                          options);
}

// What edges and the tag say for a camera, as far as that can be compared with its second-best one.
double NatsFor(const AlignedPhotograph& photograph, const AlignmentScore& score) {
  return score.nats - 0.5 * photograph.whitened.squaredNorm() + photograph.log_probability;
}

// With the model's edges where each photograph by itself took them to be.
double NatsAlone(const AlignedPhotograph& photograph,
                 const EdgeModel& edge_model,
                 const ScoreOptions& options) {
  return NatsFor(photograph, ScoreOf(photograph, edge_model.moves_in_world, options));
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

// What edges and other photographs say for the camera that the set has found. It is scored as the
// photograph's own solution was, by what that one saw.
Evidence EvidenceFor(const AlignmentScore& score,
                     const BestElsewhere& elsewhere,
                     const TieSupport& support,
                     const std::function<TieSupport(const CameraParameters&)>& support_elsewhere,
                     const RegisterOptions& options) {
  Evidence evidence;
  evidence.score = score;
  if (elsewhere.camera) {
    evidence.margin_nats = elsewhere.lead_nats;
    // Patches are compared through the other camera as well only where edges do not decide.
    if (options.use_ties && *evidence.margin_nats < LeastMargin(evidence.score, options.verdict)) {
      *evidence.margin_nats +=
          CountedLead(support, support_elsewhere(*elsewhere.camera), options.tie_support);
    }
  }
  evidence.tie_nats = CountedNats(support, options.tie_support);
  return evidence;
}

void JudgeMember(size_t i,
                 JointSolution solution,
                 const PhotographSet& set,
                 const std::vector<TieView>& views,
                 const EdgeModel& edge_model,
                 const RegisterOptions& options) {
  const AlignedPhotograph& photograph = set.photographs[i];
  Registration& registration = set.alignments[i]->registration;
  TieSupport support;
  if (options.use_ties) {
    support = SupportFor(photograph, views, i, edge_model, options);
    registration.ties = {support.num_tried, support.num_agreeing, support.nats};
  }
  const auto support_elsewhere = [&](const CameraParameters& whitened) {
    AlignedPhotograph elsewhere = photograph;
    elsewhere.whitened = whitened;
    return SupportFor(elsewhere, views, i, edge_model, options);
  };
  std::vector<Eigen::Vector3d> points_in_world;
  for (const CandidateSample& found : photograph.found) {
    points_in_world.push_back(found.sample.point_in_world);
  }
  const AlignmentScore score =
      ScoreOf(photograph, set.edge_moves_in_world, options.solutions.score);
  const BestElsewhere elsewhere = FindBestElsewhere(photograph,
                                                    NatsFor(photograph, score),
                                                    set.alone[i],
                                                    points_in_world,
                                                    options.solutions.distinct_distance_px);
  Evidence evidence = EvidenceFor(score, elsewhere, support, support_elsewhere, options);
  evidence.second_best_distance_px =
      elsewhere.distance_px * registration.width_px / photograph.prior.width_px;
  if (elsewhere.camera) {
    evidence.second_best = TagFromParameters(photograph.prior.ParametersAt(*elsewhere.camera),
                                             photograph.prior.measured);
  }
  if (elsewhere.camera) {
    CoverBoth(solution.whitened,
              *elsewhere.camera,
              elsewhere.distance_px * 640 / photograph.prior.width_px,
              options.verdict,
              evidence,
              solution.covariance);
  }
  const Eigen::MatrixXd whitened_doubt = SolveLeastNorm(
      photograph.prior.root, SolveLeastNorm(photograph.prior.root, photograph.doubt).transpose());
  solution.covariance += whitened_doubt;
  FillRegistration(solution, photograph.prior, edge_model.model, points_in_world, registration);
  RecordEvidence(evidence, registration);
  registration.verdict = Verdict::kAccepted;
  registration.reasons.clear();
  ApplyJudgement(JudgeFit(evidence, options.verdict), registration);
  registration.undetermined =
      FindUndetermined(registration.sigmas, photograph.written, options.verdict);
  set.alignments[i]->conflict =
      FindConflictOf(photograph, set.edge_moves_in_world, edge_model, options);
}

// How far each camera lies from its tag, beside how far those of the whole notebook do: what all of
// its pages are wrong by is no blunder of one.
void JudgeTagsOfMembers(const RegisterOptions& options, LengthUnit unit, const PhotographSet& set) {
  std::vector<CorrectedTag> tags;
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    const AlignedPhotograph& photograph = set.photographs[i];
    tags.push_back({&photograph.written,
                    photograph.prior.ParametersAt(photograph.whitened),
                    &set.alignments[i]->registration.covariance});
  }
  const VerdictOptions verdict =
      WithOverclaim(options.verdict, OverclaimOfSet(tags, options.overclaim));
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    ApplyJudgement(
        JudgeTag(tags[i].parameters, *tags[i].written, set.photographs[i].slip, unit, verdict),
        set.alignments[i]->registration);
  }
}

// What each shares with others, beside what these share with one another.
void JudgeTiesOfMembers(const VerdictOptions& options, const PhotographSet& set) {
  Registration::Ties all;
  for (const PhotographAlignment* alignment : set.alignments) {
    if (!alignment->registration.ties) continue;
    all.num_tried += alignment->registration.ties->num_tried;
    all.num_agreeing += alignment->registration.ties->num_agreeing;
  }
  for (PhotographAlignment* alignment : set.alignments) {
    Registration& registration = alignment->registration;
    if (!registration.ties) continue;
    ApplyJudgement(JudgeTies(*registration.ties, all, options), registration);
  }
}

}  // namespace

std::vector<EdgeDisplacement> RefineSet(const EdgeModel& edge_model,
                                        const RegisterOptions& options,
                                        std::vector<PhotographAlignment>& alignments,
                                        const std::vector<SeenTagCorner>& tag_corners,
                                        std::vector<MovedTag>* moved_tags) {
  PhotographSet set;
  set.edge_moves_in_world = edge_model.moves_in_world;
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
  const std::vector<TieView> views = ViewsOf(set.photographs);
  tbb::parallel_for(size_t{0}, set.photographs.size(), [&](size_t i) {
    JudgeMember(i, joint.photographs[i], set, views, edge_model, options);
  });
  JudgeTagsOfMembers(options, edge_model.model.unit, set);
  JudgeTiesOfMembers(options.verdict, set);
  return joint.displacements;
}

}  // namespace groundglass
