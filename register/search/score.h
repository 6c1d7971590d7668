// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/edge_evidence.h"
#include "register/edges/edge_samples.h"

#include <string>
#include <vector>

namespace groundglass {

struct ScoreOptions {
  // Spread of a right match about the model's edge, px.
  double noise_px = 1.0;
  // Candidates are counted this far to both sides, to tell how crowded the place is.
  double clutter_range_px = 12;
  double observation_length_px = 20;
  double gate_deg = 25;
  // Share of a model edge that the photograph shows; candidates that are looked at for a sample.
  double shown_share = 0.65;
  int max_candidates = 64;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "score options: ") const;
};

// How much better than chance the model's edges meet the photograph's, in nats: for each edge,
// with the contrast sign that suits it better, one observation for each observation_length_px of
//   log(0.35 + 0.65 p / q),
// p the density of a right match at the nearest candidate, q the density of candidates thereabouts.
// Its zero means something: a wrong camera scores below it. An edge of a loose model may lie off
// as a whole (EdgeSample::looseness): its score is the mean over where it may lie.
struct AlignmentScore {
  double nats = 0;
  double observations = 0;  // independent ones; the score of a perfect alignment grows with them
};
AlignmentScore ScoreAlignment(const std::vector<EdgeSample>& samples,
                              const ParameterProjection& projection,
                              const EdgeEvidence& evidence,
                              const ScoreOptions& options);

// What the photograph offers for scoring one sample, so that a camera near by can be scored when
// the photograph is no longer in memory.
struct ScoreSample {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  int edge = -1;
  double observations = 0;
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  // where offset 0 lies
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();    // unit length
  double loose_px = 0;                                  // how far a loose model's edge may lie off
  double range_px = 0;                                  // to both sides that is counted
  std::vector<EdgeCandidate> candidates;
};
// spare_px: how far, px, a camera that is to be scored may see a sample from where it is seen here.
std::vector<ScoreSample> FindScoreSamples(const std::vector<EdgeSample>& samples,
                                          const ParameterProjection& projection,
                                          const EdgeEvidence& evidence,
                                          double spare_px,
                                          const ScoreOptions& options);
// The same samples where the model's edges are moved by so much: edge_moves_in_world of each, or of
// none; with -1 `times`, back. Each is asked for along the same normals.
std::vector<ScoreSample> WithEdgesMoved(std::vector<ScoreSample> samples,
                                        const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                                        double times = 1);
// What one edge says for a camera.
struct EdgeScore {
  int edge = -1;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // of its first sample
  AlignmentScore score;
};
// The score edge by edge, if each were shown offset_px, along its samples' normals, from where the
// camera sees it. Samples sorted by edge.
std::vector<EdgeScore> ScoreEdges(const std::vector<ScoreSample>& samples,
                                  const ParameterProjection& projection,
                                  double offset_px,
                                  const ScoreOptions& options);
// Their sum where the camera sees them: the same score as ScoreAlignment.
AlignmentScore ScoreFromSamples(const std::vector<ScoreSample>& samples,
                                const ParameterProjection& projection,
                                const ScoreOptions& options);

}  // namespace groundglass
