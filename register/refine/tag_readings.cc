// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/tag_readings.h"

#include "scene/advice/tag_slips.h"
#include "scene/check_option.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

bool FitsBelow(const TagReading& reading, double nats_per_observation) {
  const AlignmentScore& score = reading.solutions.front().score;
  return score.nats < nats_per_observation * score.observations;
}

// By their total scores, of solutions or of readings.
template <typename Scored>
void SortByTotalScore(std::vector<Scored>& all) {
  std::stable_sort(all.begin(), all.end(), [](const Scored& a, const Scored& b) {
    return a.TotalScore() > b.TotalScore();
  });
}

// Reads a tag in more and more ways, as long as none of them is convincing.
class TagReader {
 public:
  TagReader(const EdgeModel& edge_model,
            const EdgeEvidence& evidence,
            const CameraPrior& written,
            const SolutionOptions& solution_options,
            const ReadingOptions& options)
      : edge_model_(edge_model),
        evidence_(evidence),
        written_(written),
        solution_options_(solution_options),
        options_(options) {}

  void ReadAsWritten(const std::vector<ControlPoint>& points) {
    Add({"", 1, written_, 0, {}}, points);
  }

  bool IsDoubtful() const {
    if (readings_.empty()) return true;
    const TagReading& best = readings_.front();
    return FitsBelow(best, options_.doubt_below_nats_per_observation) ||
           LiesBeyond(best.prior.ParametersAt(best.solutions.front().refinement.whitened));
  }

  void ReadWider() {
    if (options_.wider_factor <= 1) return;
    TagReading wider{
        "", options_.wider_factor, WithWiderPose(written_, options_.wider_factor), 0, {}};
    const auto num_measured = (written_.sigmas.head<kRoll>().array() > 0).count();
    wider.log_probability = std::log(options_.wider_share) -
                            static_cast<double>(num_measured) * std::log(options_.wider_factor);
    // The search is wider, and each of its starts is followed as far as before.
    SolutionOptions solution_options = solution_options_;
    solution_options.refine.start_sigmas /= options_.wider_factor;
    wider.solutions = FindSolutions(edge_model_, evidence_, wider.prior, {}, solution_options);
    MoveSharedToWritten(wider);
    Keep(std::move(wider));
  }

  bool FitsNothing() const {
    return readings_.empty() ||
           FitsBelow(readings_.front(), options_.slips_below_nats_per_observation) ||
           readings_.front().solutions.front().score.nats < options_.slips_below_nats;
  }

  void ReadSlips(const std::function<CameraPrior(const ViewTag&)>& prior_of,
                 const std::vector<NamedTag>& other_tags) {
    if (options_.num_slips == 0) return;
    std::vector<MeantTag> meant = FindMeantTags(written_.measured);
    for (MeantTag& one : FindMeantTagsByDigits(written_.measured)) meant.push_back(std::move(one));
    for (const NamedTag& other : other_tags) {
      meant.push_back({"the numbers of " + other.name, other.tag, false, {}});
    }
    std::vector<std::pair<double, TagReading>> glances;
    for (size_t i = 0; i < meant.size(); ++i) {
      const MeantTag& one = meant[i];
      const bool is_known = std::any_of(meant.begin(),
                                        meant.begin() + static_cast<std::ptrdiff_t>(i),
                                        [&](const auto& other) { return other.tag == one.tag; });
      if (is_known) continue;
      TagReading reading{one.slip, 1, prior_of(one.tag), 0, {}};
      if (!LiesBeyond(reading.prior.mean)) continue;  // no slip, but within the tag's own errors
      reading.log_probability = std::log(options_.slip_share / static_cast<double>(meant.size()));
      if (const auto score = Glance(reading.prior))
        glances.emplace_back(*score, std::move(reading));
    }
    std::stable_sort(glances.begin(), glances.end(), [](const auto& a, const auto& b) {
      return a.first > b.first;
    });
    if (static_cast<int>(glances.size()) > options_.num_slips) glances.resize(options_.num_slips);
    for (auto& [score, reading] : glances) Add(std::move(reading), {});
    DropDoubtfulSlip();
  }

  std::vector<TagReading> BestFirst() && { return std::move(readings_); }

 private:
  // Where another camera fits almost as well, a slip explains nothing.
  void DropDoubtfulSlip() {
    if (readings_.empty() || readings_.front().slip.empty()) return;
    const Rival rival = FindRival(readings_, solution_options_);
    const double lead = readings_.front().solutions.front().TotalScore() - rival.total_score;
    if (rival.solution == nullptr || lead >= options_.min_slip_lead_nats) return;
    std::erase_if(readings_, [](const TagReading& reading) { return !reading.slip.empty(); });
  }

  bool LiesBeyond(const CameraParameters& parameters) const {
    const CameraParameters change = written_.root * written_.WhitenedAt(parameters);
    for (int i = 0; i < kNumCameraParameters; ++i) {
      if (std::abs(change[i]) > options_.doubt_beyond_sigmas * written_.sigmas[i]) return true;
    }
    return false;
  }

  // What the tag as it is written allows is no other reading: only its search may have missed it.
  void MoveSharedToWritten(TagReading& wider) {
    std::vector<Solution> beyond;
    std::vector<Hypothesis> shared;
    for (const Solution& solution : wider.solutions) {
      const CameraParameters parameters = wider.prior.ParametersAt(solution.refinement.whitened);
      if (LiesBeyond(parameters)) {
        beyond.push_back(solution);
      } else if (static_cast<int>(shared.size()) < options_.num_shared) {
        shared.push_back({written_.WhitenedAt(parameters), solution.start.score});
      }
    }
    wider.solutions = std::move(beyond);
    const auto written = std::find_if(readings_.begin(), readings_.end(), [](const auto& reading) {
      return reading.slip.empty();
    });
    TagReading as_written{"", 1, written_, 0, {}};
    if (written != readings_.end()) {
      as_written = std::move(*written);
      readings_.erase(written);
    }
    for (const Hypothesis& start : shared) {
      as_written.solutions.push_back(
          SolveFrom(start, edge_model_, evidence_, written_, {}, solution_options_));
    }
    Keep(std::move(as_written));
  }

  // How well a coarse search fits; nothing where the camera sees next to nothing of the model.
  std::optional<double> Glance(const CameraPrior& prior) const {
    const std::vector<EdgeSample> samples =
        SampleVisibleEdges(edge_model_,
                           prior.CameraAt(CameraParameters::Zero()),
                           solution_options_.search_frame_share * prior.width_px,
                           solution_options_.search_spacing_px);
    if (static_cast<int>(samples.size()) < solution_options_.min_samples) return std::nullopt;
    HypothesisOptions coarse = solution_options_.hypotheses;
    coarse.max_grid_points = options_.glance_grid_points;
    coarse.max_starts = 1;
    coarse.climbs_per_start = options_.glance_climbs;
    return solution_options_.stages.find_hypotheses(samples, prior, evidence_, coarse)
        .front()
        .score;
  }

  void Add(TagReading reading, const std::vector<ControlPoint>& points) {
    reading.solutions =
        FindSolutions(edge_model_, evidence_, reading.prior, points, solution_options_);
    Keep(std::move(reading));
  }

  void Keep(TagReading reading) {
    if (reading.solutions.empty()) return;
    SortByTotalScore(reading.solutions);
    const double nats = reading.solutions.front().score.nats;
    if (reading.widening > 1 && nats < options_.min_wider_nats) return;
    if (!reading.slip.empty() && nats < options_.min_slip_nats) return;
    readings_.push_back(std::move(reading));
    SortByTotalScore(readings_);
  }

  const EdgeModel& edge_model_;
  const EdgeEvidence& evidence_;
  const CameraPrior& written_;
  const SolutionOptions& solution_options_;
  const ReadingOptions& options_;
  std::vector<TagReading> readings_;  // best first
};

}  // namespace

void ReadingOptions::Check(const std::string& path) const {
  CheckAtLeast(doubt_below_nats_per_observation, 0, path + "doubt_below_nats_per_observation");
  CheckAbove(doubt_beyond_sigmas, 0, path + "doubt_beyond_sigmas");
  CheckFromTo(wider_factor, 1, 100, path + "wider_factor");
  CheckFromTo(wider_share, 1e-9, 1, path + "wider_share");
  CheckFromTo(num_shared, 0, 1000, path + "num_shared");
  CheckAtLeast(slips_below_nats_per_observation, 0, path + "slips_below_nats_per_observation");
  CheckAtLeast(slips_below_nats, 0, path + "slips_below_nats");
  CheckFromTo(slip_share, 1e-9, 1, path + "slip_share");
  CheckFromTo(num_slips, 0, 1000, path + "num_slips");
  CheckFromTo(glance_grid_points, 1, 100000000, path + "glance_grid_points");
  CheckFromTo(glance_climbs, 1, 1000, path + "glance_climbs");
  CheckAtLeast(min_wider_nats, 0, path + "min_wider_nats");
  CheckAtLeast(min_slip_nats, 0, path + "min_slip_nats");
  CheckAtLeast(min_slip_lead_nats, 0, path + "min_slip_lead_nats");
}

std::vector<TagReading> ReadTag(const EdgeModel& edge_model,
                                const EdgeEvidence& evidence,
                                const CameraPrior& written,
                                const std::function<CameraPrior(const ViewTag&)>& prior_of,
                                const std::vector<NamedTag>& other_tags,
                                const std::vector<ControlPoint>& points,
                                const SolutionOptions& solution_options,
                                const ReadingOptions& options) {
  TagReader reader(edge_model, evidence, written, solution_options, options);
  reader.ReadAsWritten(points);
  // Where a person has pointed, that tells where to look.
  if (points.empty() && reader.IsDoubtful()) {
    reader.ReadWider();
    if (reader.FitsNothing()) reader.ReadSlips(prior_of, other_tags);
  }
  return std::move(reader).BestFirst();
}

Rival FindRival(const std::vector<TagReading>& readings, const SolutionOptions& options) {
  const TagReading& best = readings.front();
  Rival rival;
  for (const TagReading& reading : readings) {
    const SecondBest elsewhere = FindSecondBest(
        best.solutions.front(), best.prior, reading.solutions, reading.prior, options);
    if (elsewhere.solution == nullptr) continue;
    const double total_score =
        elsewhere.solution->TotalScore() + reading.log_probability - best.log_probability;
    if (rival.solution != nullptr && total_score <= rival.total_score) continue;
    rival = {&reading, elsewhere.solution, elsewhere.distance_px, total_score};
  }
  return rival;
}

}  // namespace groundglass
