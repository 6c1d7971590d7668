// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/keep_stages.h"

#include "register/camera/mean_displacement.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

namespace groundglass {
namespace {

// One line of a CSV file.
std::string CsvLine(std::initializer_list<double> numbers) {
  std::string line;
  for (const double number : numbers) line += (line.empty() ? "" : ",") + FormatNumber(number);
  return line + "\n";
}

void AppendParameters(const CameraParameters& in_world, std::string& line) {
  const CameraParameters in_site = SiteParameters(in_world);
  for (int i = 0; i < kNumCameraParameters; ++i) line += "," + FormatNumber(in_site[i]);
}

const char* OutcomeName(Refinement::Outcome outcome) {
  switch (outcome) {
    case Refinement::Outcome::kConverged:
      return "converged";
    case Refinement::Outcome::kNotSettled:
      return "not settled";
    case Refinement::Outcome::kNoCovariance:
      return "no covariance";
    case Refinement::Outcome::kNoSolution:
      return "no solution";
    case Refinement::Outcome::kTooFewEdges:
      return "too few edges";
  }
  return "";
}

// to_photograph: pixels of the photograph for one of the picture that was aligned.
std::string SamplesCsv(const std::vector<EdgeSample>& samples,
                       const ParameterProjection& projection,
                       double to_photograph) {
  std::string text = "edge,along,x,y,z,image_x_px,image_y_px,normal_x,normal_y,length_px\n";
  const std::vector<ProjectedSample> projected = ProjectSamples(samples, projection);
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!projected[i].is_valid) continue;
    const Eigen::Vector3d in_site = SiteFromWorld(samples[i].point_in_world);
    const Eigen::Vector2d at = projected[i].image_px * to_photograph;
    const Eigen::Vector2d& normal = projected[i].normal;
    text += CsvLine({static_cast<double>(samples[i].edge),
                     samples[i].along,
                     in_site.x(),
                     in_site.y(),
                     in_site.z(),
                     at.x(),
                     at.y(),
                     normal.x(),
                     normal.y(),
                     samples[i].spacing_px * to_photograph});
  }
  return text;
}

// Best first: where each solution started, where refinement ended, and what speaks for it.
std::string SolutionsCsv(const AlignmentStages& stages, double to_photograph) {
  const CameraPrior& prior = stages.prior;
  std::string text =
      "outcome,matched,score_nats,observations,prior_nats,control_point_nats,total_nats,"
      "from_best_px,hypothesis_score";
  for (const char* prefix : {"", "hypothesis_"}) {
    for (const std::string_view name : kCameraParameterNames) {
      text += "," + std::string(prefix) + std::string(name);
    }
  }
  text += "\n";
  const Refinement& best = stages.solutions.front().refinement;
  const std::vector<Eigen::Vector3d> points_in_world = PointsOf(best.samples);
  for (const Solution& solution : stages.solutions) {
    const Refinement& refined = solution.refinement;
    const double from_best_px = MeanDisplacementPx(
        points_in_world, prior.ProjectionAt(best.whitened), prior.ProjectionAt(refined.whitened));
    std::string numbers = CsvLine({static_cast<double>(refined.num_matched),
                                   solution.score.nats,
                                   solution.score.observations,
                                   -0.5 * refined.whitened.squaredNorm(),
                                   solution.control_point_nats,
                                   solution.TotalScore(),
                                   from_best_px * to_photograph,
                                   solution.start.score});
    numbers.pop_back();
    AppendParameters(prior.ParametersAt(refined.whitened), numbers);
    AppendParameters(prior.ParametersAt(solution.start.whitened), numbers);
    text += std::string(OutcomeName(refined.outcome)) + "," + numbers + "\n";
  }
  return text;
}

// A sample with its candidates about the camera found, and where the mixture takes its edge to be.
struct KeptMatch {
  CandidateSample found;
  SoftAssignment match;  // precision 0: none is taken

  // The candidate that is meant: the nearest to where the edge is taken to be.
  bool IsTaken(const EdgeCandidate& candidate) const {
    const auto distance = [&](const EdgeCandidate& one) {
      return std::abs(one.offset_px - match.offset_px);
    };
    return match.precision > 0 &&
           std::ranges::none_of(found.candidates, [&](const EdgeCandidate& other) {
             return distance(other) < distance(candidate);
           });
  }
};

std::vector<KeptMatch> MatchLast(const AlignmentStages& stages, const RefineOptions& options) {
  const Refinement& refined = stages.solutions.front().refinement;
  std::vector<KeptMatch> matches;
  for (CandidateSample& found : FindCandidateSamples(refined.samples,
                                                     stages.evidence,
                                                     stages.prior,
                                                     stages.prior.ProjectionAt(refined.whitened),
                                                     0,
                                                     options.matching.final_range_px,
                                                     options.matching)) {
    const SoftAssignment match =
        MatchCandidates(found, 0, found.range_px, refined.noise_px, options.matching);
    matches.push_back({std::move(found), match});
  }
  return matches;
}

std::string MatchesCsv(const std::vector<KeptMatch>& matches, double to_photograph) {
  std::string text =
      "sample,edge,image_x_px,image_y_px,normal_x,normal_y,residual_px,sigma_px,"
      "candidate_offset_px,candidate_strength,taken\n";
  for (size_t i = 0; i < matches.size(); ++i) {
    const auto& [found, match] = matches[i];
    const Eigen::Vector2d at = found.origin_px * to_photograph;
    std::string sample = CsvLine({static_cast<double>(i),
                                  static_cast<double>(found.sample.edge),
                                  at.x(),
                                  at.y(),
                                  found.normal.x(),
                                  found.normal.y()});
    sample.pop_back();
    // Where none is taken, there is no residual.
    const std::string residual = match.precision > 0
                                     ? FormatNumber(match.offset_px * to_photograph) + "," +
                                           FormatNumber(to_photograph / std::sqrt(match.precision))
                                     : ",";
    for (const EdgeCandidate& candidate : found.candidates) {
      text += sample + "," + residual + "," +
              CsvLine({candidate.offset_px * to_photograph,
                       candidate.strength,
                       matches[i].IsTaken(candidate) ? 1.0 : 0.0});
    }
  }
  return text;
}

// Draws dots onto a photograph, in its pixels.
class DotPicture {
 public:
  explicit DotPicture(const Image8& grey8, double to_photograph)
      : image_(grey8.width, grey8.height, 3), to_photograph_(to_photograph) {
    for (size_t i = 0; i < grey8.values.size(); ++i) {
      // Paler, so that the dots stand out.
      std::fill_n(image_.values.begin() + 3 * static_cast<std::ptrdiff_t>(i),
                  3,
                  static_cast<uint8_t>(96 + grey8.values[i] / 2));
    }
  }

  void Dot(const Eigen::Vector2d& image_px, int radius_px, const cv::Scalar& colour) {
    // OpenCV's pixel centres lie at whole numbers; with four bits for the fraction.
    const Eigen::Vector2d at = (image_px * to_photograph_ - Eigen::Vector2d(0.5, 0.5)) * 16;
    if (!(at.cwiseAbs().maxCoeff() < 1e6)) return;
    cv::Mat canvas(image_.height, image_.width, CV_8UC3, image_.values.data());
    cv::circle(canvas,
               {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))},
               static_cast<int>(std::lround(16 * radius_px * to_photograph_)),
               colour,
               cv::FILLED,
               cv::LINE_AA,
               4);
  }

  const Image8& image() const { return image_; }

 private:
  Image8 image_;
  double to_photograph_;
};

}  // namespace

void KeepStages(const AlignmentStages& stages,
                const SolutionOptions& options,
                const std::filesystem::path& folder) {
  const cv::Scalar tag_colour(200, 80, 0);
  const cv::Scalar found_colour(0, 150, 220);
  const cv::Scalar candidate_colour(230, 200, 0);
  const cv::Scalar taken_colour(0, 130, 0);
  const std::filesystem::path own = folder / stages.name;
  const CameraPrior& prior = stages.prior;
  const double to_photograph = static_cast<double>(stages.grey8.width) / prior.width_px;
  DotPicture picture(stages.grey8, to_photograph);
  const auto keep_samples = [&](const char* name,
                                const std::vector<EdgeSample>& samples,
                                const CameraParameters& whitened,
                                const cv::Scalar& colour) {
    const ParameterProjection projection = prior.ProjectionAt(whitened);
    WriteFileAtomically(own / name, SamplesCsv(samples, projection, to_photograph));
    for (const EdgeSample& sample : samples) {
      if (const auto image_px = projection.ImageOf(sample.point_in_world)) {
        picture.Dot(*image_px, 1, colour);
      }
    }
  };
  keep_samples("samples_tag.csv",
               SampleVisibleEdges(stages.edge_model,
                                  prior.CameraAt(CameraParameters::Zero()),
                                  -options.refine.border_px,
                                  options.refine.spacing_px),
               CameraParameters::Zero(),
               tag_colour);
  if (!stages.solutions.empty()) {
    const Refinement& best = stages.solutions.front().refinement;
    keep_samples("samples_found.csv", best.samples, best.whitened, found_colour);
    WriteFileAtomically(own / "solutions.csv", SolutionsCsv(stages, to_photograph));
    const std::vector<KeptMatch> matches = MatchLast(stages, options.refine);
    WriteFileAtomically(own / "matches.csv", MatchesCsv(matches, to_photograph));
    for (const KeptMatch& kept : matches) {
      for (const EdgeCandidate& candidate : kept.found.candidates) {
        picture.Dot(kept.found.origin_px + candidate.offset_px * kept.found.normal,
                    1,
                    kept.IsTaken(candidate) ? taken_colour : candidate_colour);
      }
    }
  }
  WriteSrgb8(own / "stages.png", picture.image());
}

}  // namespace groundglass
