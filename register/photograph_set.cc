// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/photograph_set.h"

#include "register/ties/find_ties.h"

namespace groundglass {

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

AlignmentScore ScoreOf(const AlignedPhotograph& photograph,
                       const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                       const ScoreOptions& options) {
  return ScoreFromSamples(WithEdgesMoved(photograph.score_samples, edge_moves_in_world),
                          photograph.prior.ProjectionAt(photograph.whitened),
                          options);
}

double NatsFor(const AlignedPhotograph& photograph, const AlignmentScore& score) {
  return score.nats - 0.5 * photograph.whitened.squaredNorm() + photograph.log_probability;
}

double NatsAlone(const AlignedPhotograph& photograph,
                 const EdgeModel& edge_model,
                 const ScoreOptions& options) {
  return NatsFor(photograph, ScoreOf(photograph, edge_model.MovesInWorld(), options));
}

}  // namespace groundglass
