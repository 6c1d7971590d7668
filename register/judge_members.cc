// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/judge_members.h"

#include "register/fill_registration.h"
#include "register/notebook_overclaim.h"
#include "register/shared_conflict.h"
#include "scene/least_norm.h"

#include <tbb/parallel_for.h>

#include <functional>
#include <optional>
#include <vector>

namespace groundglass {
namespace {

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
// its pages are wrong by is no blunder of one. A slip is one, and no measure of the others.
void JudgeTagsOfMembers(const JointRefinement& joint,
                        const RegisterOptions& options,
                        LengthUnit unit,
                        const PhotographSet& set) {
  std::vector<CameraCovariance> covariances;
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    const CameraPrior& prior = set.photographs[i].prior;
    covariances.push_back(prior.root * joint.photographs[i].covariance * prior.root.transpose());
  }
  std::vector<CorrectedTag> as_meant;
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    const AlignedPhotograph& photograph = set.photographs[i];
    if (!photograph.slip.empty()) continue;
    as_meant.push_back(
        {&photograph.written, photograph.prior.ParametersAt(photograph.whitened), &covariances[i]});
  }
  const VerdictOptions verdict =
      WithOverclaim(options.verdict, OverclaimOfSet(as_meant, options.overclaim));
  for (size_t i = 0; i < set.photographs.size(); ++i) {
    const AlignedPhotograph& photograph = set.photographs[i];
    ApplyJudgement(JudgeTag(photograph.prior.ParametersAt(photograph.whitened),
                            photograph.written,
                            photograph.slip,
                            unit,
                            verdict),
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

void JudgeMembers(const JointRefinement& joint,
                  const EdgeModel& edge_model,
                  const RegisterOptions& options,
                  const PhotographSet& set) {
  const std::vector<TieView> views = ViewsOf(set.photographs);
  tbb::parallel_for(size_t{0}, set.photographs.size(), [&](size_t i) {
    JudgeMember(i, joint.photographs[i], set, views, edge_model, options);
  });
  JudgeTagsOfMembers(joint, options, edge_model.model.unit, set);
  JudgeTiesOfMembers(options.verdict, set);
}

}  // namespace groundglass
