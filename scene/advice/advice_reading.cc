// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// The whole scene read otherwise. A wrong axis, unit or datum moves every camera away from what it
// was said to look at; the reading under which nearly all of them look at the model again, at the
// distance of their look-at points, is the one that was meant.
#include "scene/advice/advice_judge.h"
#include "scene/advice/advice_parts.h"
#include "scene/advice/advice_readings.h"
#include "scene/frames.h"
#include "scene/quantile.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

double Score(const Suitability& suits, int num_changes) {
  return suits.plausible_share + 0.5 * suits.front_share - suits.median_lookat_error -
         0.03 * num_changes;
}

Suitability Try(const AdviceContext& context,
                const std::vector<const Photograph*>& photographs,
                const Reading& reading) {
  return FindSuitability(context, photographs, reading.model, reading.retag);
}

Reading Combined(const Reading& axes, const Reading& unit) {
  Reading both = unit;
  both.model.flips_faces = axes.model.flips_faces;
  both.model.linear = unit.model.linear * axes.model.linear;
  both.message = axes.message + ", and " + unit.message;
  both.num_changes = 2;
  return both;
}

// A model that was mirrored but stands about the origin is still looked at, from its wrong sides:
// its faces' backs and the look-at points tell.
bool IsMirrored(const Suitability& as_read, const Suitability& other, const Reading& reading) {
  return reading.model.flips_faces && as_read.front_share < 0.35 && other.front_share > 0.65 &&
         as_read.median_lookat_error > 0.05 &&
         other.median_lookat_error < 0.4 * as_read.median_lookat_error;
}

bool IsScaled(const OtherReading& model) {
  return std::abs(std::abs(model.linear.determinant()) - 1) > 1e-6;
}

// How well the pictures suit a reading, over all of them.
double FitOverAll(const AdviceContext& context, const PictureJudge& judge, const Reading& reading) {
  const std::vector<double> fits =
      judge.Fit(ReadOtherwise(context.scene.model, reading.model), reading.retag);
  return std::reduce(fits.begin(), fits.end()) / static_cast<double>(fits.size());
}

// The reading that suits the tags best, far better than the one that was read. Where others suit
// them about as well, the pictures choose.
std::optional<Reading> FindBest(const AdviceContext& context,
                                const std::vector<const Photograph*>& photographs,
                                const Suitability& as_read,
                                const std::vector<Reading>& readings,
                                const PictureJudge* judge) {
  constexpr double kAboutAsWell = 0.3;
  constexpr size_t kMostRivals = 5;
  // Of the mean fit: the edges of a wrong reading come near by chance.
  constexpr double kClearMeanLead = 0.7;
  std::vector<std::pair<double, const Reading*>> suitable;
  for (const Reading& reading : readings) {
    const Suitability suits = Try(context, photographs, reading);
    const bool is_better = suits.plausible_share >= as_read.plausible_share + 0.35 ||
                           IsMirrored(as_read, suits, reading);
    if (suits.plausible_share < 0.7 || suits.median_lookat_error > 0.12 || !is_better) continue;
    suitable.emplace_back(-Score(suits, reading.num_changes), &reading);
  }
  if (suitable.empty()) return std::nullopt;
  std::stable_sort(suitable.begin(), suitable.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  const Reading* best = suitable.front().second;
  std::erase_if(suitable, [limit = suitable.front().first + kAboutAsWell](const auto& rival) {
    return rival.first > limit;
  });
  if (!judge || suitable.size() < 2) return *best;
  double most = FitOverAll(context, *judge, *best) + kClearMeanLead;
  for (size_t i = 1; i < std::min(suitable.size(), kMostRivals); ++i) {
    const double fit = FitOverAll(context, *judge, *suitable[i].second);
    if (fit <= most) continue;
    most = fit;
    best = suitable[i].second;
  }
  return *best;
}

void AdviseOnWhatIsUnknown(const AdviceContext& context, size_t num_implausible) {
  std::vector<double> distances;
  for (const Standpoint& standpoint : context.standpoints) distances.push_back(standpoint.distance);
  const double distance = UpperMedian(std::move(distances));
  const double diagonal = context.bounds.Diagonal();
  if (distance > 30 * diagonal) {
    context.Add(Advice::Severity::kScene,
                context.scene.model_file.string(),
                "the cameras stand about " + FormatLength(distance, context.scene.model.unit) +
                    " from the model, which is " +
                    FormatLength(diagonal, context.scene.model.unit) + " from corner to corner",
                "give the tags and the model the same origin and the same unit");
    return;
  }
  context.Add(Advice::Severity::kScene,
              context.scene.folder.string(),
              std::to_string(num_implausible) + " of " +
                  std::to_string(context.standpoints.size()) +
                  " tags stand inside the model or under it, or do not show it",
              "tags and model need the same origin, axes (x east, y south in view files, z up) and "
              "unit; look at the overlays (groundglass check SCENE -o DIR)");
}

}  // namespace

Misreading AdviseOnReading(const AdviceContext& context, const PictureJudge* judge) {
  if (context.scene.photographs.size() < kFewestTags) return Misreading::kNone;
  const std::vector<const Photograph*> photographs = SomePhotographs(context.scene);
  const Suitability as_read = Try(context, photographs, {});
  const bool is_suspicious = as_read.implausible_share >= 0.5 || as_read.plausible_share <= 0.4 ||
                             as_read.median_lookat_error > 0.2 || as_read.front_share < 0.35;
  if (!is_suspicious) return Misreading::kNone;

  const std::vector<Reading> axes = OtherAxes(context);
  std::vector<Reading> readings = axes;
  const std::string axes_options = AxesOptions(context.options);
  for (const Reading& reading : OtherUnits(context, axes_options)) readings.push_back(reading);
  for (const Reading& reading : OtherTags()) readings.push_back(reading);
  for (const Reading& reading : OtherDatums(context, photographs)) readings.push_back(reading);
  for (const Reading& reading : LeftHandedAxes(context)) readings.push_back(reading);
  std::optional<Reading> best = FindBest(context, photographs, as_read, readings, judge);
  // Another size suits tags by chance where the model is one wall: the pictures know better.
  if (best && judge && IsScaled(best->model) &&
      PictureJudge::IsClearlyBetter(
          judge->Fit(context.scene.model),
          judge->Fit(ReadOtherwise(context.scene.model, best->model), best->retag))) {
    return Misreading::kNone;
  }
  // Two changes at once would fit a handful of tags by chance.
  if (!best && photographs.size() > 3) {
    readings.clear();
    for (const Reading& one : axes) {
      for (const Reading& other : OtherUnits(context, " " + one.option)) {
        readings.push_back(Combined(one, other));
      }
    }
    best = FindBest(context, photographs, as_read, readings, nullptr);
  }
  // Sizes and heights that suit a few tags by chance are many: the pictures know the heights
  // better.
  const bool is_in_place = best && best->model.linear.isIdentity(1e-9);
  if (best && judge && !best->retag && (IsScaled(best->model) || is_in_place) &&
      AdviseOnDatum(context, *judge)) {
    return Misreading::kOther;
  }
  if (best) {
    context.Add(Advice::Severity::kScene,
                context.scene.model_file.string(),
                best->message + ": only so do the cameras look at it",
                best->remedy);
    return IsScaled(best->model) ? Misreading::kOfUnit : Misreading::kOther;
  }
  if (as_read.implausible_share < 0.6) return Misreading::kNone;
  AdviseOnWhatIsUnknown(
      context,
      static_cast<size_t>(
          std::count_if(context.standpoints.begin(), context.standpoints.end(), IsImplausible)));
  return Misreading::kOther;
}

}  // namespace groundglass
