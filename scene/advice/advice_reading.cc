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
#include <optional>
#include <utility>

namespace groundglass {
namespace {

double Score(const Suitability& suits, int num_changes) {
  return suits.votes + 0.5 * suits.front_share - 0.03 * num_changes;
}

// Of the tags, so many must suit a reading: of a handful all, of more most, since some are
// mistyped.
double FewestPlausible(size_t num_tags) { return num_tags < 5 ? 0.7 : 0.6; }

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

struct Choice {
  Reading best;
  // As likely, of another size or with the tags' axes in another order: neither tags nor pictures
  // tell which.
  std::optional<Reading> rival;
  bool is_by_pictures = false;  // others suit the tags about as well, but not the pictures
};

// How far from the look-at points the model may be met, as a share of the distance looked at. What
// would fit by chance, since there are many sizes and heights to try, must be met well; there are
// few orders of the axes, and some people's look-at points lie within the building.
double MostLookatError(const Reading& reading) { return reading.retag ? 0.2 : 0.12; }

// The readings that suit most tags, far more than the one that was read; the best first, none that
// is much worse.
std::vector<std::pair<double, const Reading*>> FindSuitable(
    const AdviceContext& context,
    const std::vector<const Photograph*>& photographs,
    const Suitability& as_read,
    const std::vector<Reading>& readings) {
  constexpr double kAboutAsWell = 0.3;
  constexpr double kLead = 0.35;
  std::vector<std::pair<double, const Reading*>> suitable;
  for (const Reading& reading : readings) {
    const Suitability suits = Try(context, photographs, reading);
    const bool is_better = suits.plausible_share >= as_read.plausible_share + kLead ||
                           suits.votes >= as_read.votes + kLead ||
                           IsMirrored(as_read, suits, reading);
    if (suits.plausible_share < FewestPlausible(photographs.size()) ||
        suits.median_lookat_error > MostLookatError(reading) || !is_better) {
      continue;
    }
    suitable.emplace_back(Score(suits, reading.num_changes), &reading);
  }
  std::stable_sort(suitable.begin(), suitable.end(), [](const auto& a, const auto& b) {
    return a.first > b.first;
  });
  // Of the few orders of the axes each is shown to the pictures.
  std::erase_if(suitable,
                [&, limit = suitable.empty() ? 0 : suitable.front().first - kAboutAsWell](
                    const auto& rival) { return rival.first < limit && !rival.second->retag; });
  return suitable;
}

bool HasOtherSize(const Reading& a, const Reading& b) {
  return std::abs(a.model.linear.determinant() / b.model.linear.determinant()) > 1 + 1e-6 ||
         std::abs(b.model.linear.determinant() / a.model.linear.determinant()) > 1 + 1e-6;
}

// Two that a person who looks at the pictures or measures a length can tell apart. Those that
// differ in the model's own axes do so in which of its faces are in sight, and that tells.
bool AreRivals(const Reading& a, const Reading& b) {
  return HasOtherSize(a, b) || a.retag || b.retag;
}

// Where several readings suit the tags about as well, the pictures choose.
std::optional<Choice> FindBest(const AdviceContext& context,
                               const std::vector<const Photograph*>& photographs,
                               const Suitability& as_read,
                               const std::vector<Reading>& readings,
                               const PictureJudge* judge) {
  constexpr size_t kMostRivals = 8;
  // Of the mean fit: the edges of a wrong reading come near by chance.
  constexpr double kClearMeanLead = 0.7;
  // Of the score of a reading: half a vote and less of six is chance.
  constexpr double kClearScoreLead = 0.1;
  const auto suitable = FindSuitable(context, photographs, as_read, readings);
  if (suitable.empty()) return std::nullopt;
  const size_t count = std::min(suitable.size(), kMostRivals);
  std::vector<double> fits(count, 0);
  size_t best = 0;
  for (size_t i = 0; judge && count > 1 && i < count; ++i) {
    const Reading& reading = *suitable[i].second;
    fits[i] = PictureJudge::Mean(
        judge->Fit(ReadOtherwise(context.scene.model, reading.model), reading.retag));
    if (fits[i] > (best == 0 ? fits[0] + kClearMeanLead : fits[best])) best = i;
  }
  Choice choice{*suitable[best].second, std::nullopt};
  for (size_t i = 0; i < count; ++i) {
    if (i == best || !AreRivals(*suitable[i].second, choice.best) ||
        suitable[i].first < suitable[best].first - kClearScoreLead) {
      continue;
    }
    if (fits[i] < fits[best] - kClearMeanLead) {
      choice.is_by_pictures = true;
      continue;
    }
    choice.rival = *suitable[i].second;
    break;
  }
  return choice;
}

void Tell(const AdviceContext& context, const Choice& choice) {
  const Reading& best = choice.best;
  std::string message =
      best.message +
      (choice.is_by_pictures
           ? ": so the cameras look at it, and of what they would look at, this is what the "
             "pictures show"
           : ": only so do the cameras look at it");
  std::string remedy = best.remedy;
  if (choice.rival) {
    message = "either " + best.message + ", or " + choice.rival->message +
              ": most cameras look at it with either";
    remedy = (HasOtherSize(best, *choice.rival)
                  ? "measure a length to tell which; for the first "
                  : "on which side of the building a photograph was taken tells which; for the "
                    "first ") +
             best.remedy + "; for the second " + choice.rival->remedy;
  }
  context.Add(Advice::Severity::kScene, context.scene.model_file.string(), message, remedy);
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

// Heights of look-at points that nobody wrote. True if so.
bool AdviseOnNoHeights(const AdviceContext& context) {
  constexpr size_t kFewest = 3;  // by chance
  const std::vector<Photograph>& photographs = context.scene.photographs;
  if (photographs.size() < kFewest) return false;
  const bool are_none = std::all_of(photographs.begin(), photographs.end(), [](const auto& one) {
    return one.tag.lookat_in_site.z() == 0;
  });
  if (!are_none) return false;
  context.Add(Advice::Severity::kScene,
              context.scene.folder.string(),
              "k is 0 in every tag, as if the height of what is looked at had not been measured",
              "write the height of the point that each camera looks at");
  return true;
}

}  // namespace

Misreading AdviseOnReading(const AdviceContext& context, const PictureJudge* judge) {
  if (context.scene.photographs.size() < kFewestTags) return Misreading::kNone;
  const std::vector<const Photograph*> photographs = SomePhotographs(context.scene);
  const Suitability as_read = Try(context, photographs, {});
  const bool is_suspicious = as_read.implausible_share >= 0.5 || as_read.plausible_share < 0.7 ||
                             as_read.median_lookat_error > 0.2 || as_read.front_share < 0.35;
  if (!is_suspicious) return Misreading::kNone;

  const std::vector<Reading> axes = OtherAxes(context);
  std::vector<Reading> readings = axes;
  const std::string axes_options = AxesOptions(context.options);
  for (const Reading& reading : OtherUnits(context, axes_options)) readings.push_back(reading);
  for (const Reading& reading : OtherTags(context)) readings.push_back(reading);
  for (const Reading& reading : OtherDatums(context, photographs)) readings.push_back(reading);
  for (const Reading& reading : OtherAngles(context)) readings.push_back(reading);
  for (const Reading& reading : LookatsAsDirections(context)) readings.push_back(reading);
  for (const Reading& reading : HeightsDownwards(context)) readings.push_back(reading);
  for (const Reading& reading : LeftHandedAxes(context)) readings.push_back(reading);
  std::optional<Choice> choice = FindBest(context, photographs, as_read, readings, judge);
  // Another size suits tags by chance where the model is one wall, and another sign where look-at
  // points lie within the building: the pictures know better.
  if (choice && judge &&
      PictureJudge::IsClearlyBetter(
          judge->Fit(context.scene.model),
          judge->Fit(ReadOtherwise(context.scene.model, choice->best.model), choice->best.retag))) {
    return Misreading::kNone;
  }
  if (!choice && AdviseOnNoHeights(context)) return Misreading::kOther;
  // Two changes at once would fit a handful of tags by chance.
  if (!choice && photographs.size() > 3) {
    readings.clear();
    for (const Reading& one : axes) {
      for (const Reading& other :
           OtherUnits(context, one.option.starts_with("without") ? "" : " " + one.option)) {
        readings.push_back(Combined(one, other));
      }
    }
    choice = FindBest(context, photographs, as_read, readings, nullptr);
  }
  const Reading* best = choice ? &choice->best : nullptr;
  // Sizes and heights that suit a few tags by chance are many: the pictures know the heights
  // better.
  const bool is_in_place = best && best->model.linear.isIdentity(1e-9);
  if (best && judge && !best->retag && (IsScaled(best->model) || is_in_place) &&
      AdviseOnDatum(context, *judge)) {
    return Misreading::kOther;
  }
  if (best) {
    Tell(context, *choice);
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
