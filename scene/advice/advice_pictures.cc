// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What the pictures themselves tell: their edges lie on the model's only if they are the right way
// up and round, and the view angle is the one across the frame.
#include "scene/advice/edge_fit.h"
#include "scene/advice/picture_fit.h"
#include "scene/error.h"
#include "scene/formats/view_template.h"
#include "scene/frames.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

struct Alternative {
  AlternativeFit PictureFit::*fit;
  const char* message;
  const char* remedy;
};
constexpr std::array<Alternative, 6> kAlternatives = {{
    {&PictureFit::upside_down,
     "the picture is turned by 180 degrees",
     "turn the picture (with an image editor, or its EXIF orientation)"},
    {&PictureFit::mirrored,
     "the picture is mirrored left to right, as a slide that was scanned from its back",
     "mirror the picture with an image editor"},
    {&PictureFit::vertical_angle,
     "v is the vertical view angle",
     "v is the horizontal one: write 2 atan(a tan(v / 2)) in its place"},
    {&PictureFit::diagonal_angle,
     "v is the view angle from corner to corner, as lens makers give it",
     "v is the horizontal one: write 2 atan(a / sqrt(1 + a^2) tan(v / 2)) in its place"},
    {&PictureFit::half_angle,
     "v is half the view angle, from the axis to the frame's edge",
     "v is the whole one, from the left edge to the right one: write twice as much"},
    {&PictureFit::focal_length,
     "v is the lens's focal length in mm, before 35 mm film",
     "v is the horizontal view angle in degrees: write 2 atan(18 / v) in its place for a frame "
     "that "
     "lies, 2 atan(12 / v) for one that stands"},
}};

// Twice as much is more than fisheyes alone have.
constexpr double kLargestHalfDeg = 60;
constexpr double kMeanLead = 1;
constexpr double kMostPictures = 0.7;

bool IsClearlyMeant(const PictureFit& fit, const Alternative& alternative) {
  // Were it meant, its tag would be right: what fits far from the tag's place fits by chance.
  const double score = (fit.*alternative.fit).nearby;
  if (score < kClearScore || score < fit.as_read + kClearLead) return false;
  for (const Alternative& other : kAlternatives) {
    if (other.fit == alternative.fit) continue;
    if ((fit.*other.fit).anywhere > score - kClearLead / 2) return false;
  }
  return true;
}

bool IsMeantByMost(const std::vector<PictureFit>& fits, const Alternative& alternative) {
  double sum_of_leads = 0;
  int num_better = 0;
  int total = 0;
  for (const PictureFit& fit : fits) {
    if (fit.as_read == 0) continue;
    double rival = fit.as_read;
    for (const Alternative& other : kAlternatives) {
      if (other.fit != alternative.fit) rival = std::max(rival, (fit.*other.fit).anywhere);
    }
    const double lead = (fit.*alternative.fit).anywhere - rival;
    sum_of_leads += lead;
    num_better += lead > 0 ? 1 : 0;
    ++total;
  }
  return total >= 3 && num_better >= kMostPictures * total && sum_of_leads > kMeanLead * total;
}

ViewTag WithTangentTimes(ViewTag tag, double factor) {
  const double half = std::tan(RadiansFromDegrees(tag.view_angle_deg) / 2) * factor;
  tag.view_angle_deg = 2 * DegreesFromRadians(std::atan(half));
  return tag;
}

PictureFit FitPicture(const AdviceContext& context,
                      const std::vector<ModelEdge>& edges,
                      const Photograph& photograph) {
  const Image8 grey = ReadGrey8(photograph.image_file);
  const auto score = [&](const EdgeFit& fit, const ViewTag& tag, double nearness = 1) {
    return fit.Score(context.scene.model,
                     edges,
                     context.visibility,
                     CameraFromTag(tag, photograph.size.width, photograph.size.height),
                     nearness);
  };
  const ViewTag& tag = photograph.tag;
  const EdgeFit upright(grey);
  PictureFit result;
  result.as_read = score(upright, tag);
  if (result.as_read == 0) return result;
  result.nearby = score(upright, tag, kTagReach);
  const auto fit_of = [&](const EdgeFit& fit, const ViewTag& meant) {
    AlternativeFit scores;
    scores.anywhere = score(fit, meant);
    if (scores.anywhere >= kClearScore) scores.nearby = score(fit, meant, kTagReach);
    return scores;
  };
  result.upside_down = fit_of(EdgeFit(UpsideDown(grey)), tag);
  result.mirrored = fit_of(EdgeFit(MirroredPicture(grey)), tag);
  result.vertical_angle = fit_of(upright, WithTangentTimes(tag, tag.aspect));
  result.diagonal_angle =
      fit_of(upright, WithTangentTimes(tag, tag.aspect / std::hypot(1.0, tag.aspect)));
  if (tag.view_angle_deg < kLargestHalfDeg) {
    ViewTag doubled = tag;
    doubled.view_angle_deg *= 2;
    result.half_angle = fit_of(upright, doubled);
  }
  ViewTag by_lens = tag;
  by_lens.view_angle_deg = ViewAngleDegFromFocalLength(tag.view_angle_deg, tag.aspect);
  result.focal_length = fit_of(upright, by_lens);
  return result;
}

// True if the tag's own numbers have told what is wrong with it.
bool IsTold(const AdviceContext& context, const std::string& file) {
  return std::any_of(context.found.begin(), context.found.end(), [&](const Advice& advice) {
    return advice.subject == file;
  });
}

}  // namespace

std::vector<PictureFit> FitPictures(const AdviceContext& context) {
  const std::vector<Photograph>& photographs = context.scene.photographs;
  const std::vector<ModelEdge> edges = FindModelEdges(context.scene.model);
  std::vector<PictureFit> fits(photographs.size());
  tbb::parallel_for(size_t{0}, photographs.size(), [&](size_t i) {
    try {
      fits[i] = FitPicture(context, edges, photographs[i]);
    } catch (const Error&) {
      // A picture that cannot be read is told by those who read it for its own sake.
    }
  });
  return fits;
}

bool HasClearAlternative(const PictureFit& fit) {
  return std::any_of(kAlternatives.begin(), kAlternatives.end(), [&](const auto& alternative) {
    return IsClearlyMeant(fit, alternative);
  });
}

bool HaveCommonAlternative(const std::vector<PictureFit>& fits) {
  return std::any_of(kAlternatives.begin(), kAlternatives.end(), [&](const auto& alternative) {
    return IsMeantByMost(fits, alternative);
  });
}

void AdviseOnPictures(const AdviceContext& context, const std::vector<PictureFit>& fits) {
  const std::vector<Photograph>& photographs = context.scene.photographs;
  // What most photographs say is said of all of them, once.
  for (const Alternative& alternative : kAlternatives) {
    if (!IsMeantByMost(fits, alternative)) continue;
    context.Add(Advice::Severity::kScene,
                context.scene.folder.string(),
                "the pictures' edges suit the model better if " + std::string(alternative.message) +
                    " (in most of " + std::to_string(photographs.size()) + " photographs)",
                alternative.remedy);
    return;
  }
  for (size_t i = 0; i < fits.size(); ++i) {
    // A wrong tag makes a right picture look wrong.
    if (IsTold(context, TagPlace(context.scene, photographs[i]))) continue;
    for (const Alternative& alternative : kAlternatives) {
      if (!IsClearlyMeant(fits[i], alternative)) continue;
      context.Add(Advice::Severity::kDetail,
                  photographs[i].image_file.string(),
                  "its edges suit the model better if " + std::string(alternative.message),
                  alternative.remedy);
    }
  }
}

}  // namespace groundglass
