// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Cameras from elsewhere, whose unit or origin may be another than the model's. They have no
// look-at points; where they stand, and that they see the model, is all that tells.
#include "scene/advice/advice_judge.h"
#include "scene/advice/advice_parts.h"
#include "scene/advice/advice_readings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace groundglass {
namespace {

// Most of the model in the frame, or much of it, from outside.
bool SeesIt(const Standpoint& standpoint) {
  return !standpoint.is_inside && !standpoint.is_below_ground && standpoint.model_share >= 0.04 &&
         standpoint.apparent_size > 0.15 && standpoint.apparent_size < 4;
}

// The mean score of right cameras is above this, that of wrong ones below (picture_fit.h).
constexpr double kFittingScore = 3;
// The mean of fewer may lie there by chance.
constexpr size_t kFewestToTell = 3;

double ShareThatSees(const AdviceContext& context,
                     const std::vector<const Photograph*>& photographs,
                     const OtherReading& reading) {
  double num_seeing = 0;
  for (const Photograph* photograph : photographs) {
    num_seeing += SeesIt(FindStandpoint(context.bounds,
                                        context.visibility,
                                        context.scene.model,
                                        photograph->tag,
                                        photograph->size,
                                        reading))
                      ? 1
                      : 0;
  }
  return num_seeing / static_cast<double>(photographs.size());
}

}  // namespace

void AdviseOnGivenCameras(const AdviceContext& context, const PictureJudge& judge) {
  constexpr double kFew = 0.5;
  constexpr double kMost = 0.8;
  const std::vector<const Photograph*> photographs = SomePhotographs(context.scene);
  if (photographs.size() < kFewestTags) return;
  std::vector<Reading> readings = OtherUnits(context, AxesOptions(context.options));
  const double as_read = ShareThatSees(context, photographs, {});
  const std::vector<double> fits_as_read = judge.Fit(context.scene.model, {}, kTagReach);
  if (as_read >= kFew && PictureJudge::Mean(fits_as_read) >= kFittingScore) return;
  // Other sizes about the same origin look alike: only the pictures tell them apart.
  std::erase_if(readings, [&](const Reading& reading) {
    return ShareThatSees(context, photographs, reading.model) < kMost;
  });
  const Reading* best = FindClearlyBest(readings, context.scene.model, judge, fits_as_read, 0);
  const std::string file = context.scene.model_file.string();
  if (best) {
    context.Add(Advice::Severity::kScene,
                file,
                best->message + ": so the pictures' edges lie on its own, as the cameras see it",
                best->remedy);
  } else if (as_read < kFew) {
    context.Add(Advice::Severity::kScene,
                file,
                std::to_string(std::lround((1 - as_read) * 100)) +
                    " % of the cameras stand inside the model or under it, or hardly see it",
                "cameras and model need the same origin, axes and unit: those of a "
                "reconstruction by itself, without control points, have none of them");
  } else if (static_cast<size_t>(std::count_if(
                 fits_as_read.begin(), fits_as_read.end(), [](double fit) { return fit > 0; })) >=
             kFewestToTell) {
    context.Add(Advice::Severity::kScene,
                file,
                "the pictures' edges are not where these cameras see the model's, no more than by "
                "chance",
                "look at their origin, axes (z up?) and unit, which must be the model's; at the "
                "order of the quaternions (w first), at the principal point (the frame's middle, "
                "in pixels), and at the model's other side (--frame)");
  }
}

}  // namespace groundglass
