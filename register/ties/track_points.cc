// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/track_points.h"

#include "register/ties/flat_patch.h"
#include "scene/check_option.h"
#include "scene/model_sigma.h"
#include "scene/view_tag.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace groundglass {
namespace {

// A keypoint of a track as one of the views shows it.
struct SeenKeypoint {
  int view = -1;
  Keypoint keypoint;
};
// Those of one track.
using SeenTrack = std::vector<SeenKeypoint>;

double SigmaOf(const Keypoint& keypoint, const TrackOptions& options) {
  return std::hypot(options.floor_px, options.scale_share * keypoint.scale_px);
}

// What of the tracks these views show; tracks that two of them show.
std::vector<SeenTrack> TracksIn(const std::vector<TieView>& views) {
  const auto with_tracks = std::find_if(
      views.begin(), views.end(), [](const TieView& view) { return view.followed.tracks; });
  if (with_tracks == views.end()) return {};
  const std::vector<FeatureTrack>& tracks = *with_tracks->followed.tracks;
  std::vector<int> view_of_photograph;
  for (int view = 0; view < static_cast<int>(views.size()); ++view) {
    const int photograph = views[view].followed.photograph;
    if (photograph < 0) continue;
    if (photograph >= static_cast<int>(view_of_photograph.size())) {
      view_of_photograph.resize(photograph + 1, -1);
    }
    view_of_photograph[photograph] = view;
  }
  std::vector<SeenTrack> seen_tracks;
  for (const FeatureTrack& track : tracks) {
    SeenTrack seen;
    for (const TrackedKeypoint& tracked : track) {
      if (tracked.photograph >= static_cast<int>(view_of_photograph.size())) continue;
      const int view = view_of_photograph[tracked.photograph];
      if (view >= 0) seen.push_back({view, tracked.keypoint});
    }
    if (seen.size() > 1) seen_tracks.push_back(std::move(seen));
  }
  return seen_tracks;
}

// Neighbouring keypoints err together, and a photograph may have thousands: those tracks that most
// views show, and of these the sharpest, so many in each cell of each view's grid.
std::vector<SeenTrack> Thinned(const std::vector<SeenTrack>& tracks,
                               const std::vector<TieView>& views,
                               const TrackOptions& options) {
  std::vector<std::pair<double, size_t>> order;  // by the sharpest keypoints
  for (size_t i = 0; i < tracks.size(); ++i) {
    double sum_px = 0;
    for (const SeenKeypoint& seen : tracks[i]) sum_px += SigmaOf(seen.keypoint, options);
    order.emplace_back(sum_px / static_cast<double>(tracks[i].size()), i);
  }
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    const auto num_a = tracks[a.second].size();
    const auto num_b = tracks[b.second].size();
    return std::tie(num_b, a.first, a.second) < std::tie(num_a, b.first, b.second);
  });
  std::vector<std::vector<int>> counts(views.size());
  const auto count_in = [&](const SeenKeypoint& seen) -> int& {
    const Camera& camera = views[seen.view].camera;
    const double step_px = static_cast<double>(camera.width_px) / options.grid_columns;
    const auto num_rows = static_cast<size_t>(std::ceil(camera.height_px / step_px)) + 1;
    counts[seen.view].resize(num_rows * (options.grid_columns + 1));
    const Eigen::Vector2d cell = (seen.keypoint.image_px / step_px).cwiseMax(0);
    const size_t row = std::min(static_cast<size_t>(cell.y()), num_rows - 1);
    const size_t column =
        std::min(static_cast<size_t>(cell.x()), static_cast<size_t>(options.grid_columns));
    return counts[seen.view][row * (options.grid_columns + 1) + column];
  };
  std::vector<size_t> kept;
  for (const auto& [sigma_px, i] : order) {
    const bool is_wanted = std::any_of(tracks[i].begin(), tracks[i].end(), [&](const auto& seen) {
      return count_in(seen) < options.most_per_cell;
    });
    if (!is_wanted) continue;
    for (const SeenKeypoint& seen : tracks[i]) ++count_in(seen);
    kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  std::vector<SeenTrack> thinned;
  for (const size_t i : kept) thinned.push_back(tracks[i]);
  return thinned;
}

class TrackPlacer {
 public:
  TrackPlacer(const PolygonModel& model,
              const Visibility& visibility,
              const std::vector<TieView>& views,
              const TrackOptions& options)
      : model_sigma_(ModelSigma(model)), visibility_(visibility), views_(views), options_(options) {
    for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
      normals_in_world_.push_back(ComputeFacePlane(model, face).normal_in_world);
    }
  }

  // The point of a track, with the observations that it explains; fewer than two: there is none.
  TiePoint Place(const SeenTrack& track) const {
    TiePoint point = OnMajorityFace(track);
    while (point.observations.size() > 1) {
      const auto [worst, excess] = WorstOf(point);
      if (excess <= 1) break;
      point.observations.erase(point.observations.begin() + worst);
    }
    return point;
  }

 private:
  // Where a keypoint's ray meets the model.
  struct RayEnd {
    const SeenKeypoint* seen = nullptr;
    Eigen::Vector3d point_in_world;
    int face = -1;
  };

  std::optional<RayEnd> EndOf(const SeenKeypoint& seen) const {
    const Camera& camera = views_[seen.view].camera;
    const Eigen::Vector3d position_in_world = camera.PositionInWorld();
    const Eigen::Vector3d direction_in_world = UnprojectToWorld(camera, seen.keypoint.image_px);
    const auto hit = visibility_.FirstHit(position_in_world, direction_in_world);
    if (!hit || !hit->is_front) return std::nullopt;
    const double cos = -direction_in_world.dot(normals_in_world_[hit->face]);
    if (cos < std::cos(RadiansFromDegrees(options_.max_angle_deg))) return std::nullopt;
    return RayEnd{&seen, position_in_world + hit->distance * direction_in_world, hit->face};
  }

  // A window that is flush with its wall lies in the wall's plane: the model need not have both
  // where they are to the last pixel.
  bool ShareAPlane(const RayEnd& one, const RayEnd& other) const {
    const Eigen::Vector3d& normal = normals_in_world_[one.face];
    return one.face == other.face ||
           (normal.dot(normals_in_world_[other.face]) > kParallelCos &&
            std::abs(normal.dot(other.point_in_world - one.point_in_world)) <= model_sigma_);
  }

  TiePoint OnMajorityFace(const SeenTrack& track) const {
    std::vector<RayEnd> ends;
    for (const SeenKeypoint& seen : track) {
      if (const auto end = EndOf(seen)) ends.push_back(*end);
    }
    const RayEnd* best = nullptr;
    std::ptrdiff_t most = 0;
    for (const RayEnd& end : ends) {
      const auto num_agreeing = std::count_if(
          ends.begin(), ends.end(), [&](const auto& other) { return ShareAPlane(end, other); });
      if (num_agreeing <= most) continue;
      most = num_agreeing;
      best = &end;
    }
    TiePoint point;
    if (!best || most < 2 || 2 * most <= static_cast<std::ptrdiff_t>(track.size())) return point;
    point.face = best->face;
    point.normal_in_world = normals_in_world_[best->face];
    for (const RayEnd& end : ends) {
      if (!ShareAPlane(*best, end)) continue;
      point.point_in_world += end.point_in_world;
      point.observations.push_back(ObservationOf(*end.seen));
    }
    point.point_in_world /= static_cast<double>(most);
    point.point_in_world -= point.normal_in_world.dot(point.point_in_world - best->point_in_world) *
                            point.normal_in_world;
    return point;
  }

  TieObservation ObservationOf(const SeenKeypoint& seen) const {
    return {seen.view,
            seen.keypoint.image_px,
            Eigen::Matrix2d::Identity() / SigmaOf(seen.keypoint, options_)};
  }

  // The observation that is farthest from where the point is seen, placed where all agree best, and
  // how many times as far as is allowed; what no camera sees is infinitely far.
  std::pair<std::ptrdiff_t, double> WorstOf(const TiePoint& point) const {
    const size_t num_rows = 2 * point.observations.size() + 1;
    Eigen::MatrixXd by_point(num_rows, 3);
    Eigen::VectorXd rest(num_rows);
    for (size_t i = 0; i < point.observations.size(); ++i) {
      const TieObservation& observation = point.observations[i];
      const Camera& camera = views_[observation.photograph].camera;
      const auto image_px = Project(camera, point.point_in_world);
      const auto image_by_point = ImageByPoint(camera, point.point_in_world);
      if (!image_px || !image_by_point) return {i, INFINITY};
      rest.segment<2>(2 * i) = *image_px - observation.image_px;
      by_point.middleRows<2>(2 * i) = *image_by_point;
    }
    // Relief is no fault: next to the pixels' the prior of its depth is weak.
    rest[num_rows - 1] = 0;
    by_point.row(num_rows - 1) =
        point.normal_in_world.transpose() / (options_.relief_sigmas * model_sigma_);
    const Eigen::Matrix3d normal_matrix = by_point.transpose() * by_point;
    rest -= by_point * normal_matrix.ldlt().solve(by_point.transpose() * rest);
    std::pair<std::ptrdiff_t, double> worst = {0, 0};
    for (size_t i = 0; i < point.observations.size(); ++i) {
      const TieView& view = views_[point.observations[i].photograph];
      const double gate_px = options_.gate_share * view.camera.width_px +
                             options_.gate_sigmas * view.followed.sigma_px;
      const double excess = rest.segment<2>(2 * i).norm() / gate_px;
      if (!(excess <= worst.second)) worst = {i, excess};
    }
    return worst;
  }

  static constexpr double kParallelCos = 0.9995;

  double model_sigma_;
  const Visibility& visibility_;
  const std::vector<TieView>& views_;
  const TrackOptions& options_;
  std::vector<Eigen::Vector3d> normals_in_world_;
};

// Each view of a track is compared with each other one.
void CountTrack(const SeenTrack& track, const TiePoint& point, std::vector<TieCounts>& counts) {
  for (const SeenKeypoint& seen : track) {
    counts[seen.view].num_tried += static_cast<int>(track.size()) - 1;
  }
  if (point.observations.size() < 2) return;
  for (const TieObservation& observation : point.observations) {
    counts[observation.photograph].num_matched += static_cast<int>(point.observations.size()) - 1;
  }
}

TiePoints PlaceAll(const std::vector<SeenTrack>& tracks,
                   const PolygonModel& model,
                   const Visibility& visibility,
                   const std::vector<TieView>& views,
                   const TrackOptions& options) {
  const TrackPlacer placer(model, visibility, views, options);
  std::vector<TiePoint> points(tracks.size());
  tbb::parallel_for(
      size_t{0}, tracks.size(), [&](size_t i) { points[i] = placer.Place(tracks[i]); });
  TiePoints ties;
  ties.counts.resize(views.size());
  for (size_t i = 0; i < tracks.size(); ++i) {
    CountTrack(tracks[i], points[i], ties.counts);
    if (points[i].observations.size() > 1) ties.points.push_back(std::move(points[i]));
  }
  return ties;
}

}  // namespace

void TrackOptions::Check(const std::string& path) const {
  CheckAbove(floor_px, 0, path + "floor_px");
  CheckAtLeast(scale_share, 0, path + "scale_share");
  CheckFromTo(max_angle_deg, 0, 89, path + "max_angle_deg");
  CheckAbove(gate_share, 0, path + "gate_share");
  CheckAtLeast(gate_sigmas, 0, path + "gate_sigmas");
  CheckAbove(relief_sigmas, 0, path + "relief_sigmas");
  CheckFromTo(grid_columns, 1, 1000, path + "grid_columns");
  CheckFromTo(most_per_cell, 1, 1e6, path + "most_per_cell");
}

TiePoints PlaceTracks(const PolygonModel& model,
                      const Visibility& visibility,
                      const std::vector<TieView>& views,
                      const TrackOptions& options) {
  return PlaceAll(Thinned(TracksIn(views), views, options), model, visibility, views, options);
}

TiePoints PlaceTracksOf(int photograph,
                        const PolygonModel& model,
                        const Visibility& visibility,
                        const std::vector<TieView>& views,
                        const TrackOptions& options) {
  std::vector<SeenTrack> tracks = TracksIn(views);
  std::erase_if(tracks, [&](const SeenTrack& track) {
    return std::none_of(track.begin(), track.end(), [&](const SeenKeypoint& seen) {
      return seen.view == photograph;
    });
  });
  return PlaceAll(Thinned(tracks, views, options), model, visibility, views, options);
}

}  // namespace groundglass
