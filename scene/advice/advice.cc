// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/advice.h"

#include "scene/advice/advice_judge.h"
#include "scene/advice/advice_parts.h"
#include "scene/advice/picture_fit.h"
#include "scene/building_bounds.h"

#include <fmt/format.h>

#include <optional>

namespace groundglass {

std::string FormatAdvice(const Advice& advice) {
  return advice.subject + ": " + advice.message + "; " + advice.remedy;
}

std::string TagPlace(const Scene& scene, const Photograph& photograph) {
  if (!photograph.view_file.empty()) return photograph.view_file.string();
  return (scene.folder / "tags.csv").string() + ": " + photograph.name;
}

std::string ListNames(const std::vector<std::string>& names) {
  constexpr size_t kMost = 5;
  std::string list;
  for (size_t i = 0; i < names.size() && i < kMost; ++i) {
    const bool is_last = i + 1 == names.size();
    list += (i == 0 ? "" : is_last ? " and " : ", ") + names[i];
  }
  if (names.size() > kMost) list += " and " + std::to_string(names.size() - kMost) + " more";
  return list;
}

std::string FormatLength(double length, LengthUnit unit) {
  if (unit == LengthUnit::kMetre) return fmt::format("{:.4g} m", length);
  return fmt::format("{:.4g} {} ({:.3g} m)", length, UnitName(unit), length * MetresPerUnit(unit));
}

bool IsImplausible(const Standpoint& standpoint) {
  return standpoint.model_share < 0.01 || standpoint.is_inside || standpoint.is_below_ground;
}

bool IsPlausible(const Standpoint& standpoint) {
  return standpoint.model_share >= 0.04 && !standpoint.is_inside && !standpoint.is_below_ground &&
         standpoint.lookat_error <= 0.2 && standpoint.apparent_size > 0.08 &&
         standpoint.size_share > 0.01;
}

namespace {

// Nearly nothing that the photographs show of the model is a front.
bool ShowsBacksOnly(const AdviceContext& context) {
  constexpr double kFewFronts = 0.1;
  double model_share = 0;
  double front_share = 0;
  for (const Standpoint& standpoint : context.standpoints) {
    model_share += standpoint.model_share;
    front_share += standpoint.model_share * standpoint.front_share;
  }
  return front_share < kFewFronts * model_share;
}

std::vector<Standpoint> FindStandpoints(const Scene& scene,
                                        const Box& bounds,
                                        const Visibility& visibility) {
  std::vector<Standpoint> standpoints;
  for (const Photograph& photograph : scene.photographs) {
    standpoints.push_back(
        FindStandpoint(bounds, visibility, scene.model, photograph.tag, photograph.size));
  }
  return standpoints;
}

}  // namespace

std::vector<Advice> FindModelOddities(const Scene& scene, const ModelOptions& options) {
  std::vector<Advice> found;
  if (scene.model.faces.empty()) {
    AdviseOnUnreadModel(scene, options, found);
    return found;
  }
  const Visibility visibility(scene.model);
  const Box bounds = ComputeBuildingBounds(scene.model);
  const AdviceContext context{
      scene, options, bounds, visibility, FindStandpoints(scene, bounds, visibility), found};
  if (AdviseOnDegrees(context)) return found;
  // Such cameras need not be held by people, who tell the unit.
  AdviseOnModel(context, Misreading::kOther);
  const PictureJudge judge(scene);
  AdviseOnGivenCameras(context, judge);
  if (!ShowsBacksOnly(context)) AdviseOnWinding(context);
  return found;
}

std::vector<Advice> FindOddities(const Scene& scene,
                                 const ModelOptions& options,
                                 bool with_pictures) {
  std::vector<Advice> found;
  if (scene.model.faces.empty()) {
    AdviseOnUnreadModel(scene, options, found);
    return found;
  }
  const Visibility visibility(scene.model);
  const Box bounds = ComputeBuildingBounds(scene.model);
  const AdviceContext context{
      scene, options, bounds, visibility, FindStandpoints(scene, bounds, visibility), found};
  // Nothing else means anything then.
  if (AdviseOnDegrees(context)) return found;
  std::optional<PictureJudge> pictures;
  if (with_pictures) pictures.emplace(scene);
  const PictureJudge* judge = with_pictures ? &*pictures : nullptr;
  const Misreading misreading = AdviseOnReading(context, judge);
  AdviseOnModel(context, misreading);
  // Where some faces show their fronts, the others are turned by themselves.
  const bool has_turned =
      misreading == Misreading::kNone && !ShowsBacksOnly(context) && AdviseOnWinding(context);
  // One cause, one advice: what a model that was misread does to its tags and pictures is no news.
  const bool is_misread =
      misreading != Misreading::kNone || (!has_turned && AdviseOnBacks(context, judge)) ||
      (judge && (AdviseOnMirror(context, *judge) || AdviseOnDatum(context, *judge)));
  std::vector<PictureFit> fits;
  if (!is_misread) {
    std::vector<TagDoubt> doubts = FindTagDoubts(context);
    if (with_pictures) {
      fits = FitPictures(context);
      if (AdviseOnOrder(context, fits, doubts) || AdviseOnNoFit(context, fits, *judge)) {
        doubts.clear();
        fits.clear();
      }
      WeighTags(context, fits, doubts);
    }
    AdviseOnTags(context, doubts);
  }
  AdviseOnFrames(context);
  if (with_pictures) {
    AdviseOnDoubles(context);
    // Where the tags are misread, what masks hide of the model means nothing.
    if (!is_misread) AdviseOnMasks(context);
  }
  if (!fits.empty()) AdviseOnPictures(context, fits);
  return found;
}

}  // namespace groundglass
