// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine_accepted.h"

#include "register/fill_registration.h"
#include "scene/error.h"

#include <map>
#include <tuple>

namespace groundglass {
namespace {

// What photographs of the same lens have in common.
using LensKey = std::tuple<std::string, int, int, double, double>;

LensKey LensKeyOf(const Registration& registration) {
  const ViewTag& tag = registration.measured;
  if (!tag.camera.empty()) return {tag.camera, 0, 0, 0, 0};
  return {"", registration.width_px, registration.height_px, tag.view_angle_deg, tag.aspect};
}

// What speaks for the camera that the photographs found together. It is scored as the photograph's
// own solution was, by what that one saw; the second-best's score stays, its own best.
Evidence EvidenceFor(const CameraParameters& whitened,
                     const AlignedPhotograph& photograph,
                     const ScoreOptions& options) {
  Evidence evidence;
  evidence.score =
      ScoreFromSamples(photograph.score_samples, photograph.prior.ProjectionAt(whitened), options);
  evidence.second_best_distance_px = photograph.second_best_distance_px;
  if (photograph.second_best_nats) {
    evidence.margin_nats =
        evidence.score.nats - 0.5 * whitened.squaredNorm() - *photograph.second_best_nats;
  }
  return evidence;
}

}  // namespace

std::vector<EdgeDisplacement> RefineAccepted(const EdgeModel& edge_model,
                                             const RegisterOptions& options,
                                             std::vector<PhotographAlignment>& alignments) {
  std::vector<PhotographAlignment*> together;
  std::vector<AlignedPhotograph> photographs;
  std::vector<int> lenses;
  std::map<LensKey, int> lens_of_key;
  for (PhotographAlignment& alignment : alignments) {
    if (alignment.registration.verdict != Verdict::kAccepted) continue;
    if (alignment.aligned.found.empty()) continue;
    together.push_back(&alignment);
    photographs.push_back(std::move(alignment.aligned));
    const int next = static_cast<int>(lens_of_key.size());
    lenses.push_back(lens_of_key.emplace(LensKeyOf(alignment.registration), next).first->second);
  }
  if (photographs.size() < 2) return {};
  JointOptions joint_options = options.joint;
  if (options.prior.digital) {
    // No mount and no scan gives a photograph a scale of its own.
    joint_options.own_view_angle_share = joint_options.own_k1_share;
    joint_options.own_aspect_share = joint_options.own_k1_share;
  }
  const JointRefinement joint =
      options.refine_together(edge_model, photographs, lenses, joint_options);
  for (const JointSolution& solution : joint.photographs) {
    if (!solution.whitened.allFinite() || !solution.covariance.allFinite()) {
      throw Error("register: the photographs' common solution has no covariance");
    }
  }
  for (size_t i = 0; i < photographs.size(); ++i) {
    const AlignedPhotograph& photograph = photographs[i];
    Registration& registration = together[i]->registration;
    std::vector<Eigen::Vector3d> points_in_world;
    for (const CandidateSample& found : photograph.found) {
      points_in_world.push_back(found.sample.point_in_world);
    }
    const JointSolution& solution = joint.photographs[i];
    FillRegistration(solution, photograph.prior, edge_model.model, points_in_world, registration);
    const Evidence evidence = EvidenceFor(solution.whitened, photograph, options.solutions.score);
    RecordEvidence(evidence, registration);
    ApplyJudgement(JudgeFit(evidence, options.verdict), registration);
    ApplyJudgement(JudgeInnovation(solution.whitened, photograph.prior, options.verdict),
                   registration);
    registration.undetermined =
        FindUndetermined(registration.sigmas, photograph.prior, options.verdict);
  }
  return joint.displacements;
}

}  // namespace groundglass
