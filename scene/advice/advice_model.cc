// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What a model tells about itself: too large, too small, saved through single precision.
#include "scene/advice/advice_parts.h"
#include "scene/model_sigma.h"
#include "scene/quantile.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace groundglass {
namespace {

// Beyond these a model is no building and no town.
constexpr double kLargestModelMetres = 8000;
constexpr double kSmallestModelMetres = 0.02;
// People hold a camera at this height above what they stand on.
constexpr double kLowestEyeMetres = 1.1;
constexpr double kHighestEyeMetres = 2.3;
constexpr double kSmallestBuildingMetres = 2;
constexpr double kLargestTownMetres = 3000;

constexpr std::array<LengthUnit, 5> kCandidates = {LengthUnit::kMillimetre,
                                                   LengthUnit::kMetre,
                                                   LengthUnit::kFoot,
                                                   LengthUnit::kCentimetre,
                                                   LengthUnit::kInch};

// The height of the cameras above the model's foot, in the model's unit: the median.
std::optional<double> MedianEyeHeight(const AdviceContext& context) {
  std::vector<double> heights;
  for (const Standpoint& standpoint : context.standpoints) {
    heights.push_back(standpoint.position_in_site.z() - context.bounds.min.z());
  }
  if (heights.empty()) return std::nullopt;
  return UpperMedian(std::move(heights));
}

// The unit in which the model has a building's size and the cameras are held by people.
std::optional<LengthUnit> FindLikelyUnit(double diagonal, const std::optional<double>& eye_height) {
  for (const LengthUnit unit : kCandidates) {
    const double metres = MetresPerUnit(unit);
    const bool is_building =
        diagonal * metres > kSmallestBuildingMetres && diagonal * metres < kLargestTownMetres;
    const bool is_held = !eye_height || (*eye_height * metres > kLowestEyeMetres &&
                                         *eye_height * metres < kHighestEyeMetres);
    if (is_building && is_held) return unit;
  }
  return std::nullopt;
}

bool IsGltf(const AdviceContext& context) {
  const std::string extension = LowerCase(context.scene.model_file.extension().string());
  return extension == ".glb" || extension == ".gltf";
}

// `with_eyes`: the cameras' heights above the model's foot mean something.
void AdviseOnSize(const AdviceContext& context, bool with_eyes) {
  const PolygonModel& model = context.scene.model;
  const double metres = MetresPerUnit(model.unit);
  const double diagonal = context.bounds.Diagonal();
  const std::optional<double> eye_height = with_eyes ? MedianEyeHeight(context) : std::nullopt;
  const bool is_large = diagonal * metres > kLargestModelMetres;
  const bool is_small = diagonal * metres < kSmallestModelMetres;
  const bool has_odd_eyes = eye_height && (*eye_height * metres < 0.6 || *eye_height * metres > 8);
  // A unit that somebody has stated is doubted only where it cannot be.
  if (!is_large && !is_small && !(model.is_unit_assumed && has_odd_eyes)) return;
  LengthUnit likely = FindLikelyUnit(diagonal, eye_height).value_or(model.unit);
  if (likely == model.unit && is_large) {
    likely = FindLikelyUnit(diagonal, std::nullopt).value_or(model.unit);
  }
  const bool is_known = likely != model.unit;
  if (!is_large && !is_small && !is_known) return;

  const std::string file = context.scene.model_file.string();
  const std::string assumed = model.is_unit_assumed ? ", a unit that is only assumed" : "";
  std::string message;
  if (is_large || is_small) {
    message = "the model is " + FormatLength(diagonal, model.unit) + " from corner to corner" +
              assumed + ": too " + (is_large ? "large" : "small") + " for a building";
  } else {
    message = "the cameras stand " + FormatLength(*eye_height, model.unit) +
              " above the model's foot" + assumed;
  }
  if (is_known && IsGltf(context)) {
    context.Add(Advice::Severity::kScene,
                file,
                message,
                "glTF counts in metres; it was written in " + UnitName(likely) +
                    ", it seems: scale it by " + FormatNumber(MetresPerUnit(likely)) +
                    " where it was made");
  } else if (is_known) {
    context.Add(Advice::Severity::kScene,
                file,
                message,
                "in " + UnitName(likely) + " it would be " +
                    FormatNumber(std::round(diagonal * MetresPerUnit(likely) * 10) / 10) +
                    " m from corner to corner: give --unit " + UnitName(likely));
  } else {
    context.Add(Advice::Severity::kScene,
                file,
                message,
                "give its unit with --unit (" + UnitNames() + ")" +
                    (is_small ? ", or scale it where it was made" : ""));
  }
}

// A unit that was stated and cannot well be: cameras all around the building stand at about the
// same height and look up, as people do from the ground, but at a height where nobody stands. From
// roofs, masts and drones they look down, or stand at different heights.
void AdviseOnStatedUnit(const AdviceContext& context) {
  constexpr size_t kFewest = 4;
  constexpr size_t kFewestSides = 3;
  constexpr double kMost = 0.7;
  constexpr double kAlike = 1.3;  // between the heights, from the lowest fifth to the middle
  constexpr double kLowestDoubtfulMetres = 0.7;
  constexpr double kHighestDoubtfulMetres = 3.5;
  const PolygonModel& model = context.scene.model;
  if (model.is_unit_assumed || IsGltf(context)) return;
  std::vector<double> heights;
  std::set<std::string> sides;
  size_t num_up = 0;
  for (size_t i = 0; i < context.standpoints.size(); ++i) {
    const Standpoint& standpoint = context.standpoints[i];
    const ViewTag& tag = context.scene.photographs[i].tag;
    if (!IsPlausible(standpoint)) continue;
    heights.push_back(standpoint.position_in_site.z() - context.bounds.min.z());
    sides.insert(standpoint.bearing);
    num_up += tag.lookat_in_site.z() > tag.position_in_site.z() ? 1 : 0;
  }
  const size_t count = heights.size();
  if (count < kFewest || sides.size() < kFewestSides || num_up < kMost * count) return;
  std::sort(heights.begin(), heights.end());
  const double eye = heights[count / 2];
  const double metres = MetresPerUnit(model.unit);
  if (heights.front() <= 0 || heights[count * 7 / 10] > kAlike * heights[count / 5]) return;
  if (eye * metres > kLowestDoubtfulMetres && eye * metres < kHighestDoubtfulMetres) return;
  const std::optional<LengthUnit> likely = FindLikelyUnit(context.bounds.Diagonal(), eye);
  if (!likely || *likely == model.unit) return;
  context.Add(Advice::Severity::kDetail,
              context.scene.model_file.string(),
              "the cameras stand about " + FormatLength(eye, model.unit) +
                  " above the model's foot and look up, on all sides of it, where hardly anybody "
                  "holds a camera; its unit, " +
                  UnitName(model.unit) + ", is stated and may be wrong",
              "in " + UnitName(*likely) + " it would be " +
                  FormatNumber(std::round(eye * MetresPerUnit(*likely) * 10) / 10) +
                  " m: if its numbers are in " + UnitName(*likely) + ", give --unit " +
                  UnitName(*likely));
}

}  // namespace

namespace {

// A tolerance with which no line of the model could be told from another.
void AdviseOnTolerance(const AdviceContext& context) {
  constexpr double kMostShare = 0.05;
  const PolygonModel& model = context.scene.model;
  const double diagonal = context.bounds.Diagonal();
  if (!(ModelSigma(model) > kMostShare * diagonal)) return;
  context.Add(Advice::Severity::kScene,
              context.scene.model_file.string(),
              "its edges may lie " + FormatLength(ModelSigma(model), model.unit) +
                  " off, and it is " + FormatLength(diagonal, model.unit) +
                  " from corner to corner: no line of it can be told from another",
              "say in the model's unit how far its edges may be off ('% sigma:' in the model, or "
              "--sigma-model)");
}

}  // namespace

void AdviseOnModel(const AdviceContext& context, Misreading misreading) {
  AdviseOnTolerance(context);
  // How high cameras stand says something of the unit only where most of them look at the model.
  constexpr double kMost = 0.7;
  const auto num_plausible =
      std::count_if(context.standpoints.begin(), context.standpoints.end(), IsPlausible);
  const bool with_eyes =
      misreading == Misreading::kNone &&
      static_cast<double>(num_plausible) >= kMost * static_cast<double>(context.standpoints.size());
  if (misreading != Misreading::kOfUnit) AdviseOnSize(context, with_eyes);
  if (misreading == Misreading::kNone && context.found.empty()) AdviseOnStatedUnit(context);
  AdviseOnRaster(context);
}

}  // namespace groundglass
