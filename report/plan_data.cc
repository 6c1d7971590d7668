// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_data.h"
#include "report/report_text.h"
#include "scene/symmetric_eigen.h"
#include "scene/text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

namespace mustache = kainjow::mustache;

// The drawing's width, and its units beside everything.
constexpr double kPlanWidth = 1000;
constexpr double kPlanMargin = 40;
// More names than these would hide the stations.
constexpr size_t kMostNames = 60;
// A correction is drawn so much larger that the middle one is about this long.
constexpr double kArrowLength = 26;
constexpr std::array<double, 7> kFactors = {1, 2, 5, 10, 20, 50, 100};

// To a tenth of the drawing's units, as SVG writes numbers.
std::string Coordinate(double value) { return FormatNumber(std::round(value * 10) / 10 + 0.0); }

// From `site` (y south, which is down on the plan as it is) to the drawing.
struct PlanScale {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  double factor = 1;
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  Eigen::Vector2d Of(const Eigen::Vector3d& in_site) const {
    return (in_site.head<2>() - corner) * factor + Eigen::Vector2d::Constant(kPlanMargin);
  }
};

std::vector<const Registration*> Readable(const ReportInput& input) {
  std::vector<const Registration*> readable;
  for (const Registration& registration : *input.registrations) {
    if (registration.verdict != Verdict::kUnreadable) readable.push_back(&registration);
  }
  return readable;
}

// In `site`, what is on the plan but for what is drawn enlarged.
Eigen::AlignedBox2d BoundsOf(const ReportInput& input,
                             const std::vector<const Registration*>& stations) {
  Eigen::AlignedBox2d bounds;
  for (const Registration* station : stations) {
    bounds.extend(Eigen::Vector2d(station->measured.position_in_site.head<2>()));
    bounds.extend(Eigen::Vector2d(station->corrected.position_in_site.head<2>()));
  }
  if (input.scene) {
    for (const Eigen::Vector3d& point : input.scene->model.points_in_world) {
      bounds.extend(Eigen::Vector2d(SiteFromWorld(point).head<2>()));
    }
  }
  return bounds;
}

PlanScale ScaleFor(const Eigen::AlignedBox2d& bounds) {
  PlanScale scale;
  scale.corner = bounds.min();
  const double longest = std::max({bounds.sizes().x(), bounds.sizes().y(), 1e-9});
  scale.factor = (kPlanWidth - 2 * kPlanMargin) / longest;
  scale.size = bounds.sizes() * scale.factor + Eigen::Vector2d::Constant(2 * kPlanMargin);
  return scale;
}

std::string ModelPath(const ReportInput& input, const PlanScale& scale) {
  if (!input.scene) return "";
  const PolygonModel& model = input.scene->model;
  std::string path;
  for (const Face& face : model.faces) {
    for (size_t i = 0; i < face.points.size(); ++i) {
      const Eigen::Vector2d at = scale.Of(SiteFromWorld(model.points_in_world[face.points[i]]));
      path += (i == 0 ? "M" : "L") + Coordinate(at.x()) + " " + Coordinate(at.y());
    }
    path += "Z";
  }
  return path;
}

// How many times corrections are enlarged.
double ChooseFactor(const std::vector<const Registration*>& stations, const PlanScale& scale) {
  std::vector<double> lengths;
  for (const Registration* station : stations) {
    if (!HasCorrection(station->verdict)) continue;
    lengths.push_back(scale.factor *
                      (station->corrected.position_in_site - station->measured.position_in_site)
                          .head<2>()
                          .norm());
  }
  if (lengths.empty()) return 1;
  std::sort(lengths.begin(), lengths.end());
  const double middle = std::max(1e-9, lengths[lengths.size() / 2]);
  double chosen = 1;
  for (const double factor : kFactors) {
    if (factor * middle <= kArrowLength) chosen = factor;
  }
  return chosen;
}

// The ellipse of 95 % of all errors of a place, in `site`.
struct PlaceEllipse {
  Eigen::Vector2d radii;    // the longer one second
  Eigen::Vector2d longest;  // its direction
};
PlaceEllipse EllipseOf(const Registration& station) {
  constexpr double kShare95 = 2.4477;
  const Eigen::Matrix2d covariance = SiteCovariance(station.covariance).topLeftCorner<2, 2>();
  const SymmetricEigen axes = DecomposeSymmetric(covariance);
  return {kShare95 * axes.values.cwiseMax(0).cwiseSqrt(), axes.vectors.col(1)};
}

// What is drawn enlarged has its place too, but one place that hardly anything is known of does not
// make all others small.
Eigen::AlignedBox2d WithEllipses(const Eigen::AlignedBox2d& bounds,
                                 const std::vector<const Registration*>& stations,
                                 double factor) {
  constexpr double kMostShare = 0.4;
  Eigen::AlignedBox2d whole = bounds;
  for (const Registration* station : stations) {
    if (!HasCorrection(station->verdict)) continue;
    const Eigen::Vector2d measured = station->measured.position_in_site.head<2>();
    const Eigen::Vector2d corrected = station->corrected.position_in_site.head<2>();
    const Eigen::Vector2d middle = measured + factor * (corrected - measured);
    const PlaceEllipse ellipse = EllipseOf(*station);
    const Eigen::Vector2d across(-ellipse.longest.y(), ellipse.longest.x());
    const Eigen::Vector2d reach = factor * ((ellipse.radii.y() * ellipse.longest).cwiseAbs2() +
                                            (ellipse.radii.x() * across).cwiseAbs2())
                                               .cwiseSqrt();
    whole.extend(Eigen::Vector2d(middle - reach));
    whole.extend(Eigen::Vector2d(middle + reach));
  }
  const Eigen::Vector2d most =
      Eigen::Vector2d::Constant(kMostShare * std::max(bounds.sizes().maxCoeff(), 1e-9));
  return whole.intersection(Eigen::AlignedBox2d(Eigen::Vector2d(bounds.min() - most),
                                                Eigen::Vector2d(bounds.max() + most)));
}

// In the drawing.
mustache::data EllipseData(const Registration& station,
                           const Eigen::Vector2d& middle,
                           double factor) {
  const PlaceEllipse known = EllipseOf(station);
  const Eigen::Vector2d radii = factor * known.radii;
  const Eigen::Vector2d& longest = known.longest;
  mustache::data ellipse;
  ellipse["x"] = Coordinate(middle.x());
  ellipse["y"] = Coordinate(middle.y());
  ellipse["rx"] = Coordinate(std::max(radii.y(), 1.0));
  ellipse["ry"] = Coordinate(std::max(radii.x(), 1.0));
  ellipse["turn"] = Coordinate(DegreesFromRadians(std::atan2(longest.y(), longest.x())));
  return ellipse;
}

mustache::data StationData(const Registration& station,
                           const PlanScale& scale,
                           double factor,
                           bool with_name) {
  const Eigen::Vector2d from = scale.Of(station.measured.position_in_site);
  const Eigen::Vector2d to = from + factor * (scale.Of(station.corrected.position_in_site) - from);
  const Eigen::Vector2d ahead =
      (station.corrected.lookat_in_site - station.corrected.position_in_site).head<2>();
  const Eigen::Vector2d tip = from + 34 * ahead / std::max(1e-9, ahead.norm());
  const bool is_corrected = HasCorrection(station.verdict);
  mustache::data data;
  data["name"] = station.name;
  data["verdict"] = std::string(VerdictName(station.verdict));
  data["x"] = Coordinate(from.x());
  data["y"] = Coordinate(from.y());
  data["ahead_x"] = Coordinate(tip.x());
  data["ahead_y"] = Coordinate(tip.y());
  data["label"] = with_name;
  data["label_x"] = Coordinate(from.x() + 8);
  data["label_y"] = Coordinate(from.y() - 8);
  data["arrow"] = false;
  data["ellipse"] = false;
  if (is_corrected) {
    mustache::data arrow;
    arrow["to_x"] = Coordinate(to.x());
    arrow["to_y"] = Coordinate(to.y());
    data["arrow"] = std::move(arrow);
    data["ellipse"] = EllipseData(station, to, factor * scale.factor);
  }
  return data;
}

}  // namespace

mustache::data PlanData(const ReportInput& input) {
  if (!input.registrations) return false;
  const std::vector<const Registration*> stations = Readable(input);
  if (stations.empty()) return false;
  const Eigen::AlignedBox2d bounds = BoundsOf(input, stations);
  const double factor = ChooseFactor(stations, ScaleFor(bounds));
  const PlanScale scale = ScaleFor(WithEllipses(bounds, stations, factor));
  mustache::list list;
  for (const Registration* station : stations) {
    list.push_back(StationData(*station, scale, factor, stations.size() <= kMostNames));
  }
  mustache::data data;
  data["width"] = Coordinate(scale.size.x());
  data["height"] = Coordinate(scale.size.y());
  data["model"] = ModelPath(input, scale);
  data["stations"] = list;
  data["factor"] = false;
  if (factor > 1) data["factor"] = FormatRounded(factor, 15);
  return data;
}

}  // namespace groundglass
