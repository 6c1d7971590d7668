// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// A model whose faces show their backs, or that is mirrored, or both: the tags tell the one, the
// pictures the other.
#include "scene/advice/advice_judge.h"
#include "scene/advice/advice_parts.h"
#include "scene/advice/advice_readings.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

// Axes that mirror the model, if the tags suit them as well: faces that show their backs may then
// come of either. Where one of the two suits far better, that is what is meant.
std::optional<Reading> MirroredReading(const AdviceContext& context) {
  if (context.scene.photographs.size() < kFewestTags) return std::nullopt;
  const std::vector<const Photograph*> photographs = SomePhotographs(context.scene);
  const Suitability as_read = FindSuitability(context, photographs, {}, {});
  for (const Reading& reading : OtherAxes(context)) {
    if (!reading.model.flips_faces) continue;
    const Suitability suits = FindSuitability(context, photographs, reading.model, reading.retag);
    const bool is_possible = suits.plausible_share >= 0.7 && suits.median_lookat_error <= 0.12 &&
                             suits.front_share > 0.65;
    const bool is_worse = suits.median_lookat_error > 0.05 &&
                          as_read.median_lookat_error < 0.4 * suits.median_lookat_error;
    if (is_possible && !is_worse) return reading;
  }
  return std::nullopt;
}

// The model mirrored about its own middle. `shows_backs`: as it was read.
std::vector<Reading> MirrorsAboutItsMiddle(const AdviceContext& context, bool shows_backs) {
  const Eigen::Vector3d middle = context.bounds.Center();
  const MeshAxes axes = AxesOf(context.scene.model_file, context.options);
  const Eigen::Vector3d twice = 2 * (WorldFromAxes(axes).inverse() * middle);
  const std::array<std::string, 3> names = {"x", "y", "z"};
  std::vector<Reading> readings;
  for (const int axis : {0, 1}) {
    // North is another axis in a file with y up.
    const int in_file = axis == 1 && axes == MeshAxes::kYUp ? 2 : axis;
    Reading& reading = readings.emplace_back();
    reading.model.linear(axis, axis) = -1;
    reading.model.offset[axis] = 2 * middle[axis];
    reading.model.flips_faces = shows_backs;
    reading.message = std::string("it is mirrored, ") +
                      (axis == 0 ? "east and west" : "north and south") + " exchanged";
    const std::string& name = names[static_cast<size_t>(in_file)];
    reading.remedy = "mirror it back where it was made: " + name + " becomes " +
                     FormatNumber(std::round(1000 * twice[in_file]) / 1000) + " - " + name;
    if (!shows_backs) {
      reading.remedy += context.options.flip_faces ? ", and leave out --flip-faces"
                                                   : ", and turn its faces (--flip-faces)";
    }
  }
  return readings;
}

struct MirrorVerdict {
  std::optional<Reading> mirrored;  // that the pictures suit far better
  std::optional<Reading> rival;     // and that they suit as well as this one
  bool is_better_as_read = true;    // than all that were tried
};

MirrorVerdict FindMirror(const AdviceContext& context,
                         const PictureJudge& judge,
                         const std::vector<Reading>& candidates,
                         const std::vector<double>& as_read) {
  const std::vector<const Photograph*> photographs = SomePhotographs(context.scene);
  // Of the mean fit, as elsewhere (advice_reading.cc).
  constexpr double kClearMeanLead = 0.7;
  MirrorVerdict verdict;
  std::vector<std::pair<double, const Reading*>> better;
  for (const Reading& reading : candidates) {
    const Suitability suits = FindSuitability(context, photographs, reading.model, reading.retag);
    if (suits.plausible_share < 0.7) continue;
    const std::vector<double> fits =
        judge.Fit(ReadOtherwise(context.scene.model, reading.model), reading.retag);
    const double sum = std::reduce(fits.begin(), fits.end());
    if (!PictureJudge::IsClearlyBetter(as_read, fits)) verdict.is_better_as_read = false;
    if (PictureJudge::IsClearlyBetter(fits, as_read)) better.emplace_back(sum, &reading);
  }
  std::stable_sort(
      better.begin(), better.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (!better.empty()) verdict.mirrored = *better[0].second;
  if (better.size() > 1 &&
      better[1].first > better[0].first - kClearMeanLead * static_cast<double>(as_read.size())) {
    verdict.rival = *better[1].second;
  }
  return verdict;
}

}  // namespace

bool AdviseOnMirror(const AdviceContext& context, const PictureJudge& judge) {
  std::vector<Reading> candidates = OtherTags(context);
  for (Reading& reading : OtherAxes(context)) {
    if (reading.model.linear.determinant() > 0) continue;
    // y the other way: told of the tags and of the model together.
    if (reading.model.linear.isApprox(Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix())) {
      continue;
    }
    // Its fronts are in sight as it was read.
    reading.model.flips_faces = false;
    reading.remedy += context.options.flip_faces ? ", and leave out --flip-faces" : " --flip-faces";
    candidates.push_back(reading);
  }
  for (const Reading& reading : MirrorsAboutItsMiddle(context, false)) {
    candidates.push_back(reading);
  }
  const std::vector<double> as_read = judge.Fit(context.scene.model);
  const MirrorVerdict verdict = FindMirror(context, judge, candidates, as_read);
  if (!verdict.mirrored) return false;
  std::string message = verdict.mirrored->message;
  std::string remedy = verdict.mirrored->remedy;
  if (verdict.rival) {
    message = "either " + message + ", or " + verdict.rival->message;
    remedy = "for the first " + remedy + "; for the second " + verdict.rival->remedy;
  }
  context.Add(Advice::Severity::kScene,
              context.scene.model_file.string(),
              message + ", as the pictures' edges tell",
              remedy);
  return true;
}

bool AdviseOnBacks(const AdviceContext& context, const PictureJudge* judge) {
  double model_share = 0;
  double back_share = 0;
  for (const Standpoint& standpoint : context.standpoints) {
    model_share += standpoint.model_share;
    back_share += standpoint.model_share * (1 - standpoint.front_share);
  }
  if (model_share == 0 || back_share < 0.5 * model_share) return false;
  const std::string shown = std::to_string(std::lround(100 * back_share / model_share)) +
                            " % of what the photographs show of the model are backs of faces, "
                            "which take no texture: ";
  const std::string clockwise = "their points run clockwise";
  std::optional<Reading> mirrored = MirroredReading(context);
  std::optional<bool> is_mirrored;
  if (!mirrored && !judge) is_mirrored = false;
  if (judge) {
    // Without its backs in sight.
    OtherReading clockwise_faces;
    clockwise_faces.flips_faces = true;
    const std::vector<double> as_read =
        judge->Fit(ReadOtherwise(context.scene.model, clockwise_faces));
    std::vector<Reading> candidates = MirrorsAboutItsMiddle(context, true);
    if (mirrored) candidates.insert(candidates.begin(), *mirrored);
    const MirrorVerdict verdict = FindMirror(context, *judge, candidates, as_read);
    if (verdict.mirrored) mirrored = verdict.mirrored;
    if (verdict.mirrored) {
      is_mirrored = true;
    } else if (!mirrored || verdict.is_better_as_read) {
      is_mirrored = false;
    }
  }
  std::string why;
  std::string remedy;
  if (!is_mirrored) {
    why = clockwise + ", or " + mirrored->message + "; the tags suit either";
    remedy = "look at the overlays (groundglass check SCENE -o DIR) with --flip-faces and with " +
             mirrored->option + ", and give the one with which they fit";
  } else if (*is_mirrored) {
    why = mirrored->message + ", as the pictures' edges tell";
    remedy = mirrored->remedy;
  } else {
    why = clockwise;
    remedy = context.options.flip_faces
                 ? "leave out --flip-faces"
                 : "give --flip-faces, or turn them where the model was made";
  }
  context.Add(Advice::Severity::kScene, context.scene.model_file.string(), shown + why, remedy);
  return true;
}

}  // namespace groundglass
