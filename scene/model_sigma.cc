// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/model_sigma.h"

#include "scene/building_bounds.h"
#include "scene/error.h"
#include "scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace groundglass {
namespace {

constexpr double kSigmaOfBuildingMetres = 0.03;
constexpr double kSizeOfBuildingMetres = 15;
constexpr double kSizeInWrongUnitMetres = 1000;
constexpr double kShareInWrongUnit = 1e-3;
// What a knife and a ruler leave, unless the thing is so small that it is this share of it.
constexpr double kSigmaOfKnifeMetres = 0.0003;
constexpr double kShareOfSmallest = 0.002;

double SizeInMetres(const PolygonModel& model) {
  return ComputeBuildingBounds(model).Diagonal() * MetresPerUnit(model.unit);
}

// Small things are made more exactly, and not only in proportion: a hall of 40 m is known to 30 mm,
// its maquette at 1:100 to the same share, 0.3 mm, which in proportion to a house of 15 m would be
// 0.8 mm, too much for any photograph of it by itself.
double SigmaInMetres(double size_m) {
  if (size_m >= kSizeOfBuildingMetres) return kSigmaOfBuildingMetres;
  const double in_growth = kSigmaOfBuildingMetres * std::pow(size_m / kSizeOfBuildingMetres, 1.25);
  return std::max(in_growth, std::min(kSigmaOfKnifeMetres, kShareOfSmallest * size_m));
}

}  // namespace

double ModelScale(const PolygonModel& model) {
  const double size_m = SizeInMetres(model);
  // A model without extent is none; nothing is to be divided by its size.
  return size_m > 0 ? std::min(1.0, size_m / kSizeOfBuildingMetres) : 1;
}

double DefaultModelSigma(const PolygonModel& model) {
  const double size_m = SizeInMetres(model);
  const double sigma_m = model.is_unit_assumed && size_m > kSizeInWrongUnitMetres
                             ? kShareInWrongUnit * size_m
                             : SigmaInMetres(size_m);
  return sigma_m / MetresPerUnit(model.unit);
}

int LengthDecimals(const PolygonModel& model) {
  const double sigma = DefaultModelSigma(model);
  if (!(sigma > 0)) return 2;
  return std::clamp(static_cast<int>(std::floor(1 - std::log10(sigma))), 0, 6);
}

double ModelSigma(const PolygonModel& model) {
  return model.sigma.value_or(DefaultModelSigma(model));
}

void ReadSigmaComment(std::string_view rest,
                      const std::filesystem::path& file,
                      int line,
                      PolygonModel& model) {
  std::vector<TextToken> words;
  const std::vector<TextLine> lines = SplitLines(rest);
  if (!lines.empty()) words = lines.front().tokens;
  const std::optional<double> sigma =
      words.empty() ? std::nullopt : ParseNumber(words.front().text);
  if (!sigma || !(*sigma > 0) || !std::isfinite(*sigma)) {
    throw Error(file,
                line,
                "sigma: " + Quote(words.empty() ? "" : words.front().text) +
                    " is not a length above 0; expected how far the model's edges may lie off, in "
                    "the model's unit: 'sigma: 0.1'");
  }
  if (TrimBlanks(rest).ends_with('%')) {
    throw Error(file,
                line,
                "sigma: a share of nothing that is known; expected a length in the model's unit: "
                "'sigma: 0.1'");
  }
  // "0.1 in each direction" is no length in inches.
  const std::optional<LengthUnit> unit = words.size() == 2 ? FindUnit(words[1].text) : std::nullopt;
  if (unit && *unit != model.unit) {
    throw Error(file,
                line,
                "sigma is in " + UnitName(*unit) + ", but the model is in " + UnitName(model.unit) +
                    ": give it in the model's unit");
  }
  model.sigma = *sigma;
}

std::string DescribeModelSigma(const PolygonModel& model) {
  std::string description = fmt::format("{:.3g} {}", ModelSigma(model), UnitName(model.unit));
  if (!model.sigma) {
    description += ", by default ('% sigma:' in the model or --sigma-model says another)";
  }
  return description;
}

}  // namespace groundglass
