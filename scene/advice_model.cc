// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What a model tells about itself: too large, too small, saved through single precision.
#include "scene/advice_parts.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace groundglass {
namespace {

// Beyond these a model is no building and no town.
constexpr double kLargestModel_m = 8000;
constexpr double kSmallestModel_m = 0.02;
// People hold a camera at this height above what they stand on.
constexpr double kLowestEye_m = 1.1;
constexpr double kHighestEye_m = 2.3;
constexpr double kSmallestBuilding_m = 2;
constexpr double kLargestTown_m = 3000;

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
  std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
  return heights[heights.size() / 2];
}

// The unit in which the model has a building's size and the cameras are held by people.
std::optional<LengthUnit> FindLikelyUnit(double diagonal, const std::optional<double>& eye_height) {
  for (const LengthUnit unit : kCandidates) {
    const double metres = MetresPerUnit(unit);
    const bool is_building =
        diagonal * metres > kSmallestBuilding_m && diagonal * metres < kLargestTown_m;
    const bool is_held = !eye_height || (*eye_height * metres > kLowestEye_m &&
                                         *eye_height * metres < kHighestEye_m);
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
  const bool is_large = diagonal * metres > kLargestModel_m;
  const bool is_small = diagonal * metres < kSmallestModel_m;
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

// Numbers that went through single precision are all multiples of its step at their size; numbers
// that somebody measured are not.
void AdviseOnRaster(const AdviceContext& context) {
  const PolygonModel& model = context.scene.model;
  const double metres = MetresPerUnit(model.unit);
  constexpr std::array<const char*, 3> kAxes = {"x (east)", "y (north)", "z (up)"};
  std::string axes;
  double worst_step = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double largest = 0;
    bool is_single = true;
    std::set<double> values;
    for (const Eigen::Vector3d& point : model.points_in_world) {
      const double value = point[axis];
      largest = std::max(largest, std::abs(value));
      is_single = is_single && static_cast<double>(static_cast<float>(value)) == value;
      if (values.size() < 8) values.insert(value);
    }
    const float single = static_cast<float>(largest);
    const double step =
        static_cast<double>(std::nextafter(single, std::numeric_limits<float>::max())) -
        static_cast<double>(single);
    if (!is_single || values.size() < 4 || step * metres < 0.01) continue;
    axes += (axes.empty() ? "" : ", ") + std::string(kAxes[static_cast<size_t>(axis)]);
    worst_step = std::max(worst_step, step);
  }
  if (axes.empty()) return;
  context.Add(Advice::Severity::kDetail,
              context.scene.model_file.string(),
              "the coordinates in " + axes + " lie on a raster of " +
                  FormatLength(worst_step, model.unit) +
                  ": they were saved in single precision, which has no more digits at that size",
              "move the model near its origin before it is saved (and say where that is in '% "
              "origin:'), or save it with double precision");
}

}  // namespace

void AdviseOnModel(const AdviceContext& context, Misreading misreading) {
  if (misreading != Misreading::kOfUnit) AdviseOnSize(context, misreading == Misreading::kNone);
  AdviseOnRaster(context);
}

}  // namespace groundglass
