// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_accuracy.h"

#include "drawing/drawing_layers.h"
#include "drawing/drawing_painter.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// Shares of faces are counted in a picture no larger than this.
constexpr int kCoarsePx = 1000;
// On paper, what a draughtsman's line is sure to.
constexpr double kPromiseOnPaperMm = 0.25;
constexpr std::array<double, 10> kUsualScales = {5, 10, 20, 25, 50, 100, 200, 250, 500, 1000};

struct Weighted {
  double value = 0;
  double weight = 0;
};

std::optional<Spread> SpreadOf(std::vector<Weighted> values) {
  if (values.empty()) return std::nullopt;
  std::stable_sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) {
    return a.value < b.value;
  });
  double total = 0;
  for (const Weighted& each : values) total += each.weight;
  const auto quantile = [&](double share) {
    double sum = 0;
    for (const Weighted& each : values) {
      sum += each.weight;
      if (sum >= share * total) return each.value;
    }
    return values.back().value;
  };
  return Spread{quantile(0.1), quantile(0.5), quantile(0.9)};
}

std::string Percent(double share) {
  if (share > 0 && share < 0.01) return "less than 1 %";
  return std::to_string(std::lround(100 * share)) + " %";
}

std::string FormatSpread(const Spread& spread) {
  std::string middle = FormatLength(spread.middle);
  if (FormatLength(spread.low) == FormatLength(spread.high)) return middle;
  return middle + " (" + FormatLength(spread.low) + " to " + FormatLength(spread.high) + ")";
}

double CameraSigma(const DrawingAccuracy& accuracy) {
  return accuracy.camera_sigma_m ? accuracy.camera_sigma_m->middle : 0;
}

// What makes a place uncertain, of what anybody knows.
double Uncertainty(const DrawingAccuracy& accuracy) {
  return std::hypot(CameraSigma(accuracy),
                    accuracy.is_model_sigma_assumed ? 0 : accuracy.model_sigma_m);
}

bool IsAssumedTooCoarse(const DrawingAccuracy& accuracy) {
  return accuracy.is_model_sigma_assumed &&
         std::hypot(CameraSigma(accuracy), accuracy.model_sigma_m) > accuracy.promise_m;
}

// "1:50 promises 12.5 mm"
std::string PromiseInWords(const DrawingAccuracy& accuracy) {
  return "1:" + FormatNumber(accuracy.scale) + " promises " +
         FormatNumber(std::round(1e6 * accuracy.promise_m) / 1000) + " mm";
}

std::string ScaleThatFits(double length_m) {
  for (const double scale : kUsualScales) {
    if (kPromiseOnPaperMm / 1000 * scale >= length_m) return "1:" + FormatNumber(scale);
  }
  return "no usual scale";
}

}  // namespace

std::string FormatLength(double metres) {
  const double mm = std::abs(metres) * 1000;
  const auto rounded = [](double value) {
    const double step = std::pow(10, std::floor(std::log10(value)) - 1);
    return FormatNumber(std::round(value / step) * step);
  };
  if (mm < 1e-6) return "0 mm";
  if (mm < 100) return FormatNumber(std::round(std::stod(rounded(mm)) * 1000) / 1000) + " mm";
  return FormatNumber(std::round(std::stod(rounded(mm / 1000)) * 1000) / 1000) + " m";
}

DrawingAccuracy AssessDrawing(Renderer& renderer,
                              const TexturedModel& textured,
                              const Drawing& drawing,
                              const DrawingSources& sources,
                              double scale,
                              double pixel_size) {
  const PolygonModel& model = textured.model;
  const double metres = MetresPerUnit(model.unit);
  DrawingAccuracy accuracy;
  accuracy.scale = scale;
  accuracy.pixel_m = pixel_size * metres;
  accuracy.promise_m = kPromiseOnPaperMm / 1000 * scale;
  accuracy.model_sigma_m = ModelSigma(model) * metres;
  accuracy.is_model_sigma_assumed = !model.sigma.has_value();

  const double longest =
      std::max(drawing.UEnd() - drawing.UStart(), drawing.v_end - drawing.v_start);
  const DrawingPainter painter(
      renderer, drawing, MakeGrid(drawing, std::max(pixel_size, longest / kCoarsePx)));
  const int height_px = painter.Grid().height_px;
  std::map<int, double> pixels_of_face;
  for (const uint16_t label : painter.Faces(0, height_px).values) {
    if (label > 0) ++pixels_of_face[label - 1];
  }

  const DrawingLayers layers(painter, textured, sources);
  double shown = 0;
  double off_plane = 0;
  for (const float height_m : layers.Heights(0, height_px).values) {
    if (std::isnan(height_m)) continue;
    ++shown;
    if (std::abs(height_m) > accuracy.promise_m) ++off_plane;
    accuracy.most_before_m = std::max<double>(accuracy.most_before_m, height_m);
    accuracy.most_behind_m = std::max<double>(accuracy.most_behind_m, -height_m);
  }
  accuracy.off_plane_share = shown > 0 ? off_plane / shown : 0;

  std::vector<Weighted> footprints;
  std::vector<Weighted> sigmas;
  std::vector<Weighted> slants;
  double untextured = 0;
  for (const auto& [face, pixels] : pixels_of_face) {
    const std::vector<DrawnSource> none;
    const std::vector<DrawnSource>& here =
        face < static_cast<int>(sources.faces.size()) ? sources.faces[face] : none;
    double texels = 0;
    for (const DrawnSource& source : here) texels += source.texels;
    if (!(texels > 0)) untextured += pixels;
    for (const DrawnSource& source : here) {
      const double weight = pixels * source.texels / texels;
      if (!(weight > 0)) continue;
      footprints.push_back({source.footprint * metres, weight});
      if (source.camera_sigma) sigmas.push_back({*source.camera_sigma * metres, weight});
      if (source.slant) slants.push_back({*source.slant, weight});
    }
  }
  if (!sources.provenance.empty()) {
    const Image16 numbers = layers.Photographs(0, height_px);
    const auto photographed =
        numbers.values.size() - static_cast<size_t>(std::count(
                                    numbers.values.begin(), numbers.values.end(), kProvenanceNone));
    untextured = shown - static_cast<double>(photographed);
  }
  accuracy.untextured_share = shown > 0 ? untextured / shown : 0;
  accuracy.photograph_pixel_m = SpreadOf(footprints);
  accuracy.camera_sigma_m = SpreadOf(sigmas);
  accuracy.slant = SpreadOf(slants);
  return accuracy;
}

std::vector<std::string> DescribeAccuracy(const DrawingAccuracy& accuracy) {
  std::vector<std::string> sentences;
  std::string pixels = "At 1:" + FormatNumber(accuracy.scale) + " a pixel of the picture is " +
                       FormatLength(accuracy.pixel_m) + " on the building";
  if (accuracy.photograph_pixel_m) {
    pixels += "; the photographs' own pixel is " + FormatSpread(*accuracy.photograph_pixel_m);
  }
  pixels += "; one standard deviation of the model is " + FormatLength(accuracy.model_sigma_m);
  if (accuracy.camera_sigma_m) {
    pixels += ", of what the cameras put on it " + FormatSpread(*accuracy.camera_sigma_m);
  }
  sentences.push_back(pixels + ".");
  std::string off = Percent(accuracy.off_plane_share) + " of what is drawn lies off the plane";
  if (accuracy.off_plane_share > 0) {
    off += ", up to " + FormatLength(accuracy.most_before_m) + " before it and " +
           FormatLength(accuracy.most_behind_m) + " behind it";
  }
  off += "; it is drawn square to the plane, at the same scale.";
  sentences.push_back(off);
  if (accuracy.slant) {
    constexpr double kReveal = 0.1;
    sentences.push_back("What the model has not is drawn beside its place: a reveal " +
                        FormatLength(kReveal) + " deep by " +
                        FormatSpread({kReveal * accuracy.slant->low,
                                      kReveal * accuracy.slant->middle,
                                      kReveal * accuracy.slant->high}) +
                        ", for the slant of the photographs.");
  }
  if (accuracy.untextured_share > 0) {
    const std::string share = Percent(accuracy.untextured_share);
    sentences.push_back(static_cast<char>(std::toupper(share[0])) + share.substr(1) +
                        " of what is drawn is in no photograph, and plain grey.");
  }
  if (IsAssumedTooCoarse(accuracy)) {
    sentences.push_back("How sure the model is nobody says; the " +
                        FormatLength(accuracy.model_sigma_m) + " are assumed, and " +
                        PromiseInWords(accuracy) +
                        ". If it was measured better, say so: --sigma-model, or % sigma: in it.");
  }
  return sentences;
}

std::vector<std::string> AccuracyWarnings(const DrawingAccuracy& accuracy) {
  std::vector<std::string> warnings;
  const double uncertainty = Uncertainty(accuracy);
  if (uncertainty > accuracy.promise_m) {
    const bool is_of_model =
        !accuracy.is_model_sigma_assumed && accuracy.model_sigma_m > CameraSigma(accuracy);
    std::string which =
        is_of_model ? "the model is sure to " + FormatLength(accuracy.model_sigma_m) + " only"
                    : "the cameras put photographs on the model to " +
                          FormatLength(CameraSigma(accuracy)) + " only";
    if (is_of_model && accuracy.camera_sigma_m) {
      which += " (the cameras to " + FormatLength(CameraSigma(accuracy)) + ")";
    }
    warnings.push_back(PromiseInWords(accuracy) + " (0.25 mm on paper), but " + which + "; " +
                       ScaleThatFits(uncertainty) + " fits, or " +
                       (is_of_model ? "measure the model better"
                                    : "take photographs from nearer, or more that overlap"));
  }
  if (accuracy.photograph_pixel_m && accuracy.photograph_pixel_m->middle > accuracy.promise_m) {
    const double pixel_m = accuracy.photograph_pixel_m->middle;
    warnings.push_back(PromiseInWords(accuracy) +
                       " (0.25 mm on paper), but half of the photographs' pixels are larger than " +
                       FormatLength(pixel_m) + "; " + ScaleThatFits(pixel_m) +
                       " fits them, or take photographs from nearer, or with a longer lens");
  }
  return warnings;
}

}  // namespace groundglass
