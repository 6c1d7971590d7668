// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Coordinates that were saved in single precision, of models that can be read and of those whose
// faces were spoiled by it.
#include "scene/advice/advice_parts.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>

namespace groundglass {
namespace {

// Numbers that went through single precision are all multiples of its step at their size; numbers
// that somebody measured are not.
std::string FindRaster(const PolygonModel& model) {
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
  if (axes.empty()) return "";
  return "the coordinates in " + axes + " lie on a raster of " +
         FormatLength(worst_step, model.unit) +
         ": they were saved in single precision, which has no more digits at that size";
}

constexpr const char* kRasterRemedy =
    "move the model near its origin before it is saved (and say where that is in '% origin:'), or "
    "save it with double precision";

// The points and the unit of an .osu whose faces may be at fault.
PolygonModel ReadOsuPoints(const std::string& text) {
  PolygonModel model;
  std::vector<double> numbers;
  for (const TextLine& line : SplitLines(text)) {
    if (line.has_comment && line.comment.substr(0, 5) == "unit:") {
      model.unit = FindUnit(TrimBlanks(line.comment.substr(5))).value_or(model.unit);
    }
    for (const TextToken& token : line.tokens) {
      const std::optional<double> number = ParseNumber(token.text);
      if (!number) return {};
      numbers.push_back(*number);
    }
  }
  // After the numbers of points and of faces.
  const double num_points = numbers.size() < 2 ? 0 : numbers[0];
  for (size_t i = 0; i < num_points && 3 * i + 4 < numbers.size(); ++i) {
    model.points_in_world.push_back(
        WorldFromSite({numbers[3 * i + 2], numbers[3 * i + 3], numbers[3 * i + 4]}));
  }
  return model;
}

}  // namespace

void AdviseOnRaster(const AdviceContext& context) {
  const std::string raster = FindRaster(context.scene.model);
  if (raster.empty()) return;
  context.Add(Advice::Severity::kDetail, context.scene.model_file.string(), raster, kRasterRemedy);
}

void AdviseOnUnreadModel(const Scene& scene,
                         const ModelOptions& options,
                         std::vector<Advice>& found) {
  std::error_code error;
  if (LowerCase(scene.model_file.extension().string()) != ".osu" ||
      !std::filesystem::is_regular_file(scene.model_file, error)) {
    return;
  }
  PolygonModel model = ReadOsuPoints(ReadTextFile(scene.model_file));
  if (options.unit) model.unit = *options.unit;
  const std::string raster = FindRaster(model);
  if (raster.empty()) return;
  found.push_back({Advice::Severity::kScene,
                   scene.model_file.string(),
                   raster + "; the faults of its faces come of it",
                   kRasterRemedy});
}

}  // namespace groundglass
