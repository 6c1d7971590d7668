// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/alignment.h"

#include "register/register.h"
#include "scene/formats/ignore_mask.h"

#include <algorithm>
#include <vector>

namespace groundglass {
namespace {

// Thrown out of a stage of an alignment that nobody waits for any more.
struct AlignmentStopped {};

// The stages as they are, each of which first asks whether to go on.
void StopBetweenStages(const std::atomic<bool>& stop, SolutionStages& stages) {
  const auto asking_first = [&stop](const auto& stage) {
    return [&stop, stage](const auto&... arguments) {
      if (stop) throw AlignmentStopped();
      return stage(arguments...);
    };
  };
  stages.find_hypotheses = asking_first(stages.find_hypotheses);
  stages.refine = asking_first(stages.refine);
  stages.score = asking_first(stages.score);
}

std::vector<ControlPoint> ControlPointsOf(const std::string& photograph, const Pins& pins) {
  std::vector<ControlPoint> points;
  for (const PointPin& pin : pins.points) {
    if (pin.use != PinUse::kUsed) continue;
    points.push_back({photograph, pin.image_px, pin.point_in_world, pin.sigma_px});
  }
  if (points.size() < 3) points.clear();
  return points;
}

}  // namespace

AlignmentNews NewsOf(const Registration& registration) {
  AlignmentNews news;
  news.verdict = registration.verdict;
  news.reasons = registration.reasons;
  news.corrected = registration.corrected;
  const auto of = [&](int parameter) { return std::max(1e-6, registration.sigmas[parameter]); };
  TagSigmas& sigmas = news.corrected.sigmas;
  const TagDeviations deviations = TagDeviationsFromCovariance(
      ParametersFromTag(registration.corrected), registration.covariance, registration.corrected);
  const auto deviation = [&](TagKey key) { return deviations[static_cast<size_t>(key)]; };
  sigmas.position = std::max(of(kPositionX), of(kPositionY));
  sigmas.height = of(kPositionZ);
  sigmas.lookat =
      std::max({1e-6, deviation(TagKey::kI), deviation(TagKey::kJ), deviation(TagKey::kK)});
  sigmas.roll_deg = of(kRoll);
  sigmas.view_angle_deg = of(kViewAngle);
  sigmas.aspect = of(kAspect);
  sigmas.shift = std::max(of(kShiftX), of(kShiftY));
  sigmas.k1 = of(kK1);
  news.moved_px = registration.moved_px;
  news.vertex_sigma_px = registration.vertex_sigma_px;
  news.rms_px = registration.rms_px;
  news.margin_nats = registration.margin_nats;
  news.undetermined = registration.undetermined;
  news.rival = registration.rival;
  return news;
}

std::optional<AlignmentNews> AlignFromHere(const SessionPhotograph& photograph,
                                           const ViewTag& tag,
                                           const Pins& pins,
                                           const PolygonModel& model,
                                           const std::atomic<bool>& stop) {
  PhotographInput input;
  input.name = photograph.name;
  input.grey8 = ReadGrey8(photograph.image_file);
  if (photograph.mask_file) input.ignore = ReadIgnoreMask(*photograph.mask_file, photograph.size);
  input.measured = tag;
  input.lens = photograph.lens;
  RegisterOptions options;
  options.control_points = ControlPointsOf(photograph.name, pins);
  StopBetweenStages(stop, options.solutions.stages);
  try {
    PhotographAlignment alignment = AlignPhotograph(input, EdgeModel(model), options);
    FinishVerdict(options, alignment);
    if (stop) return std::nullopt;
    return NewsOf(alignment.registration);
  } catch (const AlignmentStopped&) {
    return std::nullopt;
  }
}

void AlignmentJob::Start(const SessionPhotograph& photograph,
                         const ViewTag& tag,
                         const Pins& pins,
                         const PolygonModel& model,
                         const std::function<void()>& on_done) {
  Stop();
  stop_ = std::make_shared<std::atomic<bool>>(false);
  job_.Start(
      [photograph, tag, pins, model, stop = stop_] {
        return AlignFromHere(photograph, tag, pins, model, *stop);
      },
      on_done);
}

void AlignmentJob::Stop() {
  if (stop_) *stop_ = true;
  job_.Drop();
}

std::optional<AlignmentNews> AlignmentJob::Take() { return job_.Take().value_or(std::nullopt); }

}  // namespace groundglass
