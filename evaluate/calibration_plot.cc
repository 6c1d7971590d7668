// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/calibration_plot.h"

#include "evaluate/svg.h"
#include "scene/error.h"
#include "scene/formats/xml_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace groundglass {
namespace {

constexpr double kPlotSide = 420;  // of the panel, in the picture's units
constexpr double kLeft = 64;
constexpr double kPlotTop = 44;
constexpr const char* kColors[] = {
    "#1b7a3d", "#3366aa", "#c77700", "#b3261e", "#7b3fa0", "#00838f", "#6d4c41", "#555555"};

double X(double share) { return kLeft + kPlotSide * share; }
double Y(double share) { return kPlotTop + kPlotSide * (1 - share); }

void DrawAxes(std::string& svg) {
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#444\"/>\n",
      kLeft,
      kPlotTop,
      kPlotSide,
      kPlotSide);
  for (int percent = 0; percent <= 100; percent += 20) {
    const double share = percent / 100.0;
    svg += fmt::format(
        "<path d=\"M{:.1f} {:.1f}V{:.1f}M{:.1f} {:.1f}H{:.1f}\" stroke=\"#ddd\" fill=\"none\"/>\n",
        X(share),
        kPlotTop,
        kPlotTop + kPlotSide,
        kLeft,
        Y(share),
        kLeft + kPlotSide);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{} %</text>\n",
                       X(share),
                       kPlotTop + kPlotSide + 16,
                       percent);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{} %</text>\n",
                       kLeft - 6,
                       Y(share) + 4,
                       percent);
  }
  svg += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">confidence claimed</text>\n",
      kLeft + kPlotSide / 2,
      kPlotTop + kPlotSide + 36);
  svg += fmt::format(
      "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">truths "
      "inside</text>\n",
      kLeft - 46,
      kPlotTop + kPlotSide / 2);
  svg += fmt::format(
      "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#888\" stroke-dasharray=\"5 4\"/>\n",
      X(0),
      Y(0),
      X(1),
      Y(1));
  // What is asked of the 95 % ellipsoid.
  svg += fmt::format(
      "<path d=\"M{:.1f} {:.1f}V{:.1f}m-4 0h8M{:.1f} {:.1f}h8\" stroke=\"#222\" fill=\"none\" "
      "stroke-width=\"2\"/>\n",
      X(0.95),
      Y(0.90),
      Y(0.98),
      X(0.95) - 4,
      Y(0.90));
}

// Steps: the share grows by one truth at each truth's own confidence.
void DrawCurve(const CalibrationCurve& curve, const char* color, std::string& svg) {
  std::vector<double> levels = curve.confidences;
  std::sort(levels.begin(), levels.end());
  std::string path;
  path += fmt::format("M{:.1f} {:.1f}", X(0), Y(0));
  for (size_t i = 0; i < levels.size(); ++i) {
    path += fmt::format("H{:.1f}V{:.1f}",
                        X(levels[i]),
                        Y(static_cast<double>(i + 1) / static_cast<double>(levels.size())));
  }
  path += fmt::format("H{:.1f}", X(1));
  svg += "<path d=\"" + path + "\" fill=\"none\" stroke-width=\"2\" stroke=\"" + color +
         "\"><title>" + XmlEscaped(curve.name) + "</title></path>\n";
}

}  // namespace

double CalibrationCurve::ShareInside(double level) const {
  if (confidences.empty()) return 0;
  const auto count = std::count_if(confidences.begin(),
                                   confidences.end(),
                                   [level](double confidence) { return confidence <= level; });
  return static_cast<double>(count) / static_cast<double>(confidences.size());
}

CalibrationCurve CalibrationCurveOf(const std::string& name, const std::vector<Trial>& trials) {
  CalibrationCurve curve{name, {}};
  for (const Trial& trial : trials) {
    if (trial.confidence) curve.confidences.push_back(*trial.confidence);
  }
  return curve;
}

CalibrationCurve ReadCalibrationCurve(const std::string& name, const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(file, "cannot be read");
  CalibrationCurve curve{name, {}};
  try {
    const nlohmann::json json = nlohmann::json::parse(stream);
    for (const nlohmann::json& trial : json.at("trials")) {
      const nlohmann::json& confidence = trial.at("confidence");
      if (!confidence.is_null()) curve.confidences.push_back(confidence.get<double>());
    }
  } catch (const nlohmann::json::exception&) {
    throw Error(file, "expected what `evaluate --trials --json` prints");
  }
  return curve;
}

std::string FormatCalibrationPlot(const std::vector<CalibrationCurve>& curves) {
  const double legend_top = kPlotTop + kPlotSide + 60;
  const double height = legend_top + 18 * static_cast<double>(curves.size()) + 8;
  std::string svg =
      SvgHead(kLeft + kPlotSide + 24, height, kLeft, "Truths inside their ellipsoids");
  DrawAxes(svg);
  for (size_t i = 0; i < curves.size(); ++i) {
    const char* color = kColors[i % std::size(kColors)];
    DrawCurve(curves[i], color, svg);
    const double y = legend_top + 18 * static_cast<double>(i);
    svg += fmt::format(
        "<path d=\"M{:.1f} {:.1f}h20\" stroke=\"{}\" stroke-width=\"2\"/>", kLeft, y - 4, color);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}: {:.0f} % of {} inside 95 %</text>\n",
                       kLeft + 28,
                       y,
                       XmlEscaped(curves[i].name),
                       100 * curves[i].ShareInside(0.95),
                       curves[i].confidences.size());
  }
  return svg + "</svg>\n";
}

}  // namespace groundglass
