// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/error_plot.h"

#include "evaluate/svg.h"
#include "scene/formats/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr double kPanelSide = 330;  // of a panel, in the picture's units
constexpr double kMargin = 64;
constexpr double kPanelTop = 54;

// Both axes cover the same whole decades, so that equal errors lie on the diagonal.
struct Panel {
  double left = 0;
  int low_decade = 0;
  int high_decade = 1;

  double Share(double value) const {
    const double decade = std::log10(std::max(value, 1e-12));
    return std::clamp((decade - low_decade) / (high_decade - low_decade), 0.0, 1.0);
  }
  double X(double value) const { return left + kPanelSide * Share(value); }
  double Y(double value) const { return kPanelTop + kPanelSide * (1 - Share(value)); }
};

Panel PanelFor(double left, const std::vector<double>& values) {
  Panel panel{left, -1, 1};
  if (values.empty()) return panel;
  // A perfect fit has no logarithm; what is below a thousandth is drawn on the border.
  const double low = std::max(*std::min_element(values.begin(), values.end()), 1e-3);
  const double high = std::max(*std::max_element(values.begin(), values.end()), 2 * low);
  panel.low_decade = static_cast<int>(std::floor(std::log10(low)));
  panel.high_decade = std::max(panel.low_decade + 1, static_cast<int>(std::ceil(std::log10(high))));
  return panel;
}

void DrawAxes(const Panel& panel,
              const std::string& x_label,
              const std::string& y_label,
              std::string& svg) {
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#444\"/>\n",
      panel.left,
      kPanelTop,
      kPanelSide,
      kPanelSide);
  for (int decade = panel.low_decade; decade <= panel.high_decade; ++decade) {
    const double value = std::pow(10.0, decade);
    const double x = panel.X(value);
    const double y = panel.Y(value);
    svg += fmt::format(
        "<path d=\"M{:.1f} {:.1f}V{:.1f}M{:.1f} {:.1f}H{:.1f}\" stroke=\"#ddd\" fill=\"none\"/>\n",
        x,
        kPanelTop,
        kPanelTop + kPanelSide,
        panel.left,
        y,
        panel.left + kPanelSide);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:g}</text>\n",
                       x,
                       kPanelTop + kPanelSide + 16,
                       value);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n",
                       panel.left - 6,
                       y + 4,
                       value);
  }
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                     panel.left + kPanelSide / 2,
                     kPanelTop + kPanelSide + 36,
                     XmlEscaped(x_label));
  svg += fmt::format(
      "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      panel.left - 44,
      kPanelTop + kPanelSide / 2,
      XmlEscaped(y_label));
}

// The line y = factor * x within the panel.
void DrawProportion(const Panel& panel,
                    double factor,
                    const char* color,
                    const char* label,
                    double label_at,
                    std::string& svg) {
  const double low = std::pow(10.0, panel.low_decade);
  const double high = std::pow(10.0, panel.high_decade);
  const double x0 = std::max(low, low / factor);
  const double x1 = std::min(high, high / factor);
  if (x0 >= x1) return;
  svg += fmt::format(
      "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-dasharray=\"5 4\"/>\n",
      panel.X(x0),
      panel.Y(x0 * factor),
      panel.X(x1),
      panel.Y(x1 * factor),
      color);
  // Beside the line, this share of its way up.
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\" fill=\"{}\">{}</text>\n",
                     std::lerp(panel.X(x0), panel.X(x1), label_at) - 8,
                     std::lerp(panel.Y(x0 * factor), panel.Y(x1 * factor), label_at),
                     color,
                     label);
}

const char* ColorOf(const std::optional<Verdict>& verdict) {
  if (!verdict) return "#555555";
  if (*verdict == Verdict::kAccepted) return "#1b7a3d";
  return *verdict == Verdict::kReview ? "#c77700" : "#b3261e";
}

void DrawPoint(
    const Panel& panel, double x, double y, const ErrorPlotPoint& point, std::string& svg) {
  svg +=
      fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\" fill-opacity=\"0.7\">",
                  panel.X(x),
                  panel.Y(y),
                  ColorOf(point.verdict));
  svg += fmt::format("<title>{}: {:.3g}, {:.3g}{}{}</title></circle>\n",
                     XmlEscaped(point.name),
                     x,
                     y,
                     point.verdict ? ", " : "",
                     point.verdict ? VerdictName(*point.verdict) : "");
}

}  // namespace

std::vector<ErrorPlotPoint> PlotPointsOf(const Evaluation& evaluation) {
  std::vector<ErrorPlotPoint> points;
  for (const PhotographEvaluation& photograph : evaluation.photographs) {
    ErrorPlotPoint point;
    point.name = photograph.name;
    point.start_px = photograph.start_px.value_or(0);
    point.end_px = photograph.errors.vertex.mean_px;
    point.position_error = photograph.errors.position;
    if (photograph.sigmas) point.position_sigma = photograph.sigmas->head<3>().norm();
    point.verdict = photograph.verdict;
    points.push_back(point);
  }
  return points;
}

std::vector<ErrorPlotPoint> PlotPointsOf(const std::vector<Trial>& trials) {
  std::vector<ErrorPlotPoint> points;
  for (const Trial& trial : trials) {
    ErrorPlotPoint point;
    point.name = trial.name + " of notebook " + std::to_string(trial.notebook + 1);
    if (trial.blunder != Blunder::kNone) {
      point.name += " (" + std::string(BlunderName(trial.blunder)) + ")";
    }
    point.start_px = trial.start_at_640_px;
    point.end_px = trial.end_at_640_px;
    point.position_error = trial.position_error;
    point.position_sigma = trial.verdict == Verdict::kRejected ? 0 : trial.position_sigma;
    point.verdict = trial.verdict;
    points.push_back(point);
  }
  return points;
}

std::string FormatErrorPlot(const std::vector<ErrorPlotPoint>& points,
                            const std::string& title,
                            const std::string& unit) {
  std::vector<double> pixels;
  std::vector<double> lengths;
  for (const ErrorPlotPoint& point : points) {
    if (point.start_px > 0) {
      pixels.push_back(point.start_px);
      pixels.push_back(point.end_px);
    }
    if (point.position_sigma > 0) {
      lengths.push_back(point.position_sigma);
      lengths.push_back(point.position_error);
    }
  }
  const Panel errors = PanelFor(kMargin, pixels);
  const Panel claims = PanelFor(2 * kMargin + kPanelSide + 16, lengths);
  const double width = claims.left + kPanelSide + 24;
  const double height = kPanelTop + kPanelSide + 76;
  std::string svg = SvgHead(width, height, kMargin, title);
  DrawAxes(errors, "vertex error at the start, px", "vertex error found, px", svg);
  DrawProportion(errors, 1, "#888888", "nothing gained", 0.9, svg);
  DrawAxes(claims, "claimed sigma of position, " + unit, "error of position, " + unit, svg);
  DrawProportion(claims, 1, "#888888", "1 sigma", 0.35, svg);
  // The 95 % radius of three independent equal axes is 2.795 of theirs, which is 1.61 of the
  // claim, the root of the sum of their squares.
  DrawProportion(claims, 2.795 / std::sqrt(3.0), "#3366aa", "95 %", 0.9, svg);
  for (const ErrorPlotPoint& point : points) {
    if (point.start_px > 0) DrawPoint(errors, point.start_px, point.end_px, point, svg);
    if (point.position_sigma > 0) {
      DrawPoint(claims, point.position_sigma, point.position_error, point, svg);
    }
  }
  double x = kMargin;
  const std::pair<std::optional<Verdict>, const char*> keys[] = {{Verdict::kAccepted, "accepted"},
                                                                 {Verdict::kReview, "review"},
                                                                 {Verdict::kRejected, "rejected"},
                                                                 {std::nullopt, "no verdict"}};
  for (const auto& [verdict, name] : keys) {
    const bool is_there =
        std::any_of(points.begin(), points.end(), [v = verdict](const ErrorPlotPoint& point) {
          return point.verdict == v;
        });
    if (!is_there) continue;
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        x,
        height - 14,
        ColorOf(verdict),
        x + 8,
        height - 10,
        name);
    x += 90;
  }
  return svg + "</svg>\n";
}

}  // namespace groundglass
