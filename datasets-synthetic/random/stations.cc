// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/stations.h"

#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/occluder_shapes.h"
#include "scene/view_tag.h"
#include "scene/visibility.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace groundglass {
namespace {

struct Extent {
  Eigen::Vector3d low, high;
};

// What a photograph is meant to show, in the plan's frame.
struct Aim {
  Extent subject;
  double fill = 0.7;                                      // of the frame
  Eigen::Vector2d direction = -Eigen::Vector2d::UnitY();  // towards the photographer
  double eye = 5;
  double view_angle_deg = 50;
  const char* comment = "";
};

struct Station {
  Eigen::Vector3d position, lookat;  // in the plan's frame
  double share = 0;                  // of the frame that the building takes
};

// As a tape gives it.
Eigen::Vector3d ToTenths(const Eigen::Vector3d& at) {
  return at.unaryExpr([](double value) { return std::round(10 * value) / 10; });
}

Extent ExtentOf(const Body& body) {
  return {{body.Low().x(), body.Low().y(), body.base},
          {body.High().x(), body.High().y(), body.Top()}};
}

// The building without its neighbours.
Extent ExtentOfBuilding(const Massing& massing) {
  Extent extent = ExtentOf(massing.bodies.front());
  for (const Body& body : massing.bodies) {
    if (body.is_neighbour) continue;
    extent.low = extent.low.cwiseMin(ExtentOf(body).low);
    extent.high = extent.high.cwiseMax(ExtentOf(body).high);
  }
  return extent;
}

// How much of the frame a box takes, the larger of across and up; beyond 9 if it reaches behind.
double FillOf(const Extent& box,
              const Eigen::Vector3d& position,
              const Eigen::Vector3d& lookat,
              double view_angle_deg,
              double aspect) {
  const Eigen::Vector3d forward = (lookat - position).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = -low;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1 ? box.high.x() : box.low.x(),
                                 i & 2 ? box.high.y() : box.low.y(),
                                 i & 4 ? box.high.z() : box.low.z());
    const Eigen::Vector3d offset = corner - position;
    const double depth = offset.dot(forward);
    if (depth < 1) return 10;
    const Eigen::Vector2d at(offset.dot(right) / depth, offset.dot(up) / depth);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const double across = 2 * std::tan(RadiansFromDegrees(view_angle_deg) / 2);
  return std::max((high.x() - low.x()) / across, (high.y() - low.y()) / (across / aspect));
}

class StationFinder {
 public:
  explicit StationFinder(const StationSite& site)
      : site_(site), visibility_(site.world.geometry), whole_(ExtentOfBuilding(site.massing)) {}

  Aim DrawAim(Draws& draws) const {
    Aim aim;
    aim.subject = whole_;
    aim.view_angle_deg =
        draws.Uniform(site_.traits.view_angle_low_deg, site_.traits.view_angle_high_deg);
    aim.view_angle_deg = std::round(2 * aim.view_angle_deg) / 2;
    aim.eye = draws.Uniform(4.6, 5.8);
    const double kind = draws.Uniform(0, 1);
    double turn_deg = draws.Uniform(-40, 40);
    aim.fill = draws.Uniform(0.45, 1.05);
    aim.comment = "From the street";
    if (kind > 0.85) {
      aim.eye = draws.Uniform(12, 35);
      aim.comment = "From a window across the street";
    } else if (kind > 0.7) {
      const auto own = static_cast<double>(std::count_if(
          site_.massing.bodies.begin(), site_.massing.bodies.end(), [](const Body& body) {
            return !body.is_neighbour;
          }));
      aim.subject = ExtentOf(site_.massing.bodies[static_cast<size_t>(draws.Uniform(0, own))]);
      aim.fill = draws.Uniform(0.95, 1.5);
      aim.comment = "Close";
    } else if (kind > 0.4) {
      turn_deg = (turn_deg > 0 ? 35 : -35) + turn_deg;
      aim.comment = "From aside";
    }
    // From the back, where people get there.
    if (draws.Chance(site_.traits.neighbours == "both" ? 0.08 : 0.2)) {
      turn_deg += 180;
      aim.comment = "From the yard";
    }
    const double turn = RadiansFromDegrees(turn_deg);
    aim.direction = {std::sin(turn), -std::cos(turn)};
    return aim;
  }

  // Stands so far away that the subject fills the frame as it is meant to.
  Station StandBack(const Aim& aim, Draws& draws) const {
    const Eigen::Vector3d size = aim.subject.high - aim.subject.low;
    Eigen::Vector3d lookat = (aim.subject.low + aim.subject.high) / 2;
    // A place on the near side.
    lookat.head<2>() += 0.42 * size.head<2>().cwiseProduct(aim.direction);
    lookat.x() += 0.12 * size.x() * draws.Uniform(-1, 1);
    lookat.z() = aim.subject.low.z() + size.z() * draws.Uniform(0.42, 0.58);
    double near = 4;
    double far = 700;
    Station station;
    station.lookat = lookat;
    for (int step = 0; step < 40; ++step) {
      const double distance = (near + far) / 2;
      station.position << lookat.head<2>() + distance * aim.direction, aim.eye;
      const double fill =
          FillOf(aim.subject, station.position, lookat, aim.view_angle_deg, site_.aspect);
      (fill > aim.fill ? near : far) = distance;
    }
    return station;
  }

  bool IsOutside(const Eigen::Vector3d& position) const {
    constexpr double kAway = 9;
    for (const Body& body : site_.massing.bodies) {
      const Eigen::Vector2d at = position.head<2>();
      const Eigen::Vector2d nearest = at.cwiseMax(body.Low()).cwiseMin(body.High());
      if ((at - nearest).norm() < kAway) return false;
    }
    return true;
  }

  // The share of the frame that shows the building; nothing if something stands close before the
  // camera, or before the building where it is looked at. The look-at point then moves along the
  // line of sight to the place that is seen there.
  std::optional<double> ShareSeen(PlannedView& view) const {
    constexpr int kColumns = 30;
    constexpr int kRows = 20;
    constexpr double kClose = 10;
    ViewTag tag;
    tag.position_in_site = view.position_in_site;
    tag.lookat_in_site = view.lookat_in_site;
    tag.view_angle_deg = view.view_angle_deg;
    tag.aspect = site_.aspect;
    const Camera camera = CameraFromTag(tag, kColumns, kRows);
    const auto middle = visibility_.FirstHit(camera.PositionInWorld(), camera.ForwardInWorld());
    if (!middle || middle->face >= site_.num_own_faces) return std::nullopt;
    view.lookat_in_site = ToTenths(
        SiteFromWorld(camera.PositionInWorld() + middle->distance * camera.ForwardInWorld()));
    int count = 0;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const auto hit = visibility_.FirstHit(camera.PositionInWorld(),
                                              UnprojectToWorld(camera, {x + 0.5, y + 0.5}));
        if (!hit) continue;
        const bool is_built = site_.world.geometry.faces[hit->face].name != kPlazaName;
        if (is_built && hit->distance < kClose) return std::nullopt;
        if (hit->face < site_.num_own_faces && hit->is_front) ++count;
      }
    }
    return static_cast<double>(count) / (kColumns * kRows);
  }

  PlannedView ViewFrom(const Station& station, const Aim& aim) const {
    PlannedView view;
    view.position_in_site = ToTenths(SiteFromWorld(site_.frame.ToWorld(station.position)));
    view.lookat_in_site = ToTenths(SiteFromWorld(site_.frame.ToWorld(station.lookat)));
    view.view_angle_deg = aim.view_angle_deg;
    view.comment = aim.comment;
    return view;
  }

  // The first station of many that is fit, or else the one that sees most.
  PlannedView Find(Draws& draws, const std::vector<PlannedView>& others) const {
    constexpr int kAttempts = 400;
    constexpr double kEnough = 0.15;
    constexpr double kApart = 10;  // feet from other stations
    PlannedView best;
    double best_share = -1;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Aim aim = DrawAim(draws);
      const Station station = StandBack(aim, draws);
      if (!IsOutside(station.position)) continue;
      PlannedView view = ViewFrom(station, aim);
      const bool is_apart =
          std::all_of(others.begin(), others.end(), [&](const PlannedView& other) {
            return (other.position_in_site - view.position_in_site).norm() > kApart;
          });
      if (!is_apart) continue;
      const std::optional<double> share = ShareSeen(view);
      if (!share || *share < best_share) continue;
      best = view;
      best_share = *share;
      if (best_share > kEnough) break;
    }
    return best;
  }

 private:
  const StationSite& site_;
  Visibility visibility_;
  Extent whole_;
};

}  // namespace

std::vector<PlannedView> DrawStations(const StationSite& site,
                                      int count,
                                      const std::string& prefix) {
  const StationFinder finder(site);
  Draws draws(SeedFor(site.seed, "random stations " + prefix));
  std::vector<PlannedView> views;
  for (int i = 0; i < count; ++i) {
    views.push_back(finder.Find(draws, views));
    views.back().name = prefix + std::to_string(i + 1);
  }
  return views;
}

}  // namespace groundglass
