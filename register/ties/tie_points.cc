// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/tie_points.h"

#include "register/ties/flat_patch.h"
#include "scene/check_option.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

// A photograph that shows a patch, and how.
struct PatchViewer {
  int photograph = -1;
  Eigen::Matrix2d image_by_patch;  // px per model's unit
  double px_per_unit = 0;          // the least
};

// A place where photographs may be compared, and those that see it, the finest first.
struct PatchPlace {
  FlatPatch patch;
  std::vector<PatchViewer> viewers;
};

class PatchLayer {
 public:
  PatchLayer(const PolygonModel& model,
             const Visibility& visibility,
             const std::vector<TieView>& views,
             const TieOptions& options)
      : visibility_(visibility), views_(views), options_(options) {
    for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
      normals_in_world_.push_back(ComputeFacePlane(model, face).normal_in_world);
    }
  }

  // Patches about what each photograph shows in a grid, one after the other; none where there is
  // one already.
  std::vector<PatchPlace> Lay() const {
    std::vector<PatchPlace> places;
    std::vector<std::vector<size_t>> places_of_face(normals_in_world_.size());
    for (int photograph = 0; photograph < static_cast<int>(views_.size()); ++photograph) {
      for (const PatchPlace& place : LookThrough(views_[photograph])) {
        std::vector<size_t>& others = places_of_face[place.patch.face];
        const bool is_taken = std::any_of(others.begin(), others.end(), [&](size_t other) {
          return Overlap(places[other].patch, place.patch);
        });
        if (is_taken) continue;
        others.push_back(places.size());
        places.push_back(place);
      }
    }
    return places;
  }

  // The same about what one photograph shows; it comes first among those who see a patch.
  std::vector<PatchPlace> LayThrough(int photograph) const {
    std::vector<PatchPlace> places = LookThrough(views_[photograph]);
    for (PatchPlace& place : places) {
      std::stable_partition(place.viewers.begin(), place.viewers.end(), [&](const auto& viewer) {
        return viewer.photograph == photograph;
      });
    }
    std::erase_if(places, [&](const PatchPlace& place) {
      return place.viewers.front().photograph != photograph;
    });
    return places;
  }

 private:
  bool Overlap(const FlatPatch& one, const FlatPatch& other) const {
    return (one.center_in_world - other.center_in_world).norm() <
           0.7 * options_.patch_texels * std::max(one.texel, other.texel);
  }

  std::vector<PatchPlace> LookThrough(const TieView& view) const {
    const double step_px = static_cast<double>(view.camera.width_px) / options_.grid_columns;
    const int num_rows = static_cast<int>(view.camera.height_px / step_px);
    std::vector<PatchPlace> cells(static_cast<size_t>(num_rows) * options_.grid_columns);
    tbb::parallel_for(size_t{0}, cells.size(), [&](size_t cell) {
      const size_t row = cell / options_.grid_columns;
      const size_t column = cell % options_.grid_columns;
      cells[cell] = PlaceAt(view,
                            {(static_cast<double>(column) + 0.5) * step_px,
                             (static_cast<double>(row) + 0.5) * step_px});
    });
    std::erase_if(cells, [](const PatchPlace& place) { return place.viewers.size() < 2; });
    return cells;
  }

  PatchPlace PlaceAt(const TieView& view, const Eigen::Vector2d& image_px) const {
    const Eigen::Vector3d position_in_world = view.camera.PositionInWorld();
    const Eigen::Vector3d direction_in_world = UnprojectToWorld(view.camera, image_px);
    const auto hit = visibility_.FirstHit(position_in_world, direction_in_world);
    if (!hit || !hit->is_front) return {};
    PatchPlace place{LayPatch(position_in_world + hit->distance * direction_in_world,
                              hit->face,
                              normals_in_world_[hit->face]),
                     {}};
    for (int photograph = 0; photograph < static_cast<int>(views_.size()); ++photograph) {
      if (const auto viewer = ViewerOf(photograph, place.patch)) place.viewers.push_back(*viewer);
    }
    if (place.viewers.size() < 2) return {};
    std::stable_sort(place.viewers.begin(), place.viewers.end(), [](const auto& a, const auto& b) {
      return a.px_per_unit > b.px_per_unit;
    });
    const double second = place.viewers[1].px_per_unit;
    place.patch.texel = 1 / second;
    std::erase_if(place.viewers, [&](const PatchViewer& viewer) {
      return viewer.px_per_unit < options_.least_resolution_share * second ||
             !IsPatchClear(
                 place.patch, options_.patch_texels, views_[viewer.photograph].camera, visibility_);
    });
    return place;
  }

  std::optional<PatchViewer> ViewerOf(int photograph, const FlatPatch& patch) const {
    const Camera& camera = views_[photograph].camera;
    const Eigen::Vector3d to_camera = camera.PositionInWorld() - patch.center_in_world;
    const double least_cos = std::cos(RadiansFromDegrees(options_.max_angle_deg));
    if (to_camera.dot(patch.normal_in_world) < least_cos * to_camera.norm()) return std::nullopt;
    const auto image_px = Project(camera, patch.center_in_world);
    if (!image_px || !IsInsideFrame(camera, *image_px)) return std::nullopt;
    const auto image_by_patch = ImageByPatch(patch, camera);
    if (!image_by_patch) return std::nullopt;
    return PatchViewer{photograph, *image_by_patch, LeastPxPerUnit(*image_by_patch)};
  }

  const Visibility& visibility_;
  const std::vector<TieView>& views_;
  const TieOptions& options_;
  std::vector<Eigen::Vector3d> normals_in_world_;
};

// Where a photograph shows the place at `offset_texels` of a patch, known to `covariance`.
TieObservation ObservationOf(const FlatPatch& patch,
                             const PatchViewer& viewer,
                             const Camera& camera,
                             const PatchMatch& match) {
  TieObservation observation;
  observation.photograph = viewer.photograph;
  observation.image_px =
      Project(camera, patch.PointInWorld(match.offset_texels)).value_or(Eigen::Vector2d::Zero());
  const Eigen::Matrix2d px_by_texels = patch.texel * viewer.image_by_patch;
  const Eigen::Matrix2d covariance_px = px_by_texels * match.covariance * px_by_texels.transpose();
  // root * root^T = covariance; its inverse whitens.
  const Eigen::Matrix2d root = covariance_px.llt().matrixL();
  observation.root_precision = root.inverse();
  return observation;
}

struct MatchedPlace {
  std::vector<TiePoint> points;
  std::vector<std::pair<int, bool>> tried;  // photographs, and whether each was found again
};

// The first photograph is looked for in all others; up to num_stars times, those in which it is not
// found may still agree with one another.
MatchedPlace MatchAtPlace(PatchPlace place,
                          int num_stars,
                          const std::vector<TieView>& views,
                          const TieOptions& options) {
  MatchedPlace matched;
  const auto flattened = [&](const PatchViewer& viewer, int texels) {
    const TieView& view = views[viewer.photograph];
    return FlattenPatch(place.patch, texels, view.camera, *view.picture);
  };
  for (int star = 0; star < num_stars && place.viewers.size() > 1; ++star) {
    const PatchViewer first = place.viewers.front();
    place.viewers.erase(place.viewers.begin());
    const std::optional<ImageF> patch = flattened(first, options.patch_texels);
    if (!patch) continue;
    PatchMatch itself;
    itself.covariance *= options.match.floor_texels * options.match.floor_texels;
    TiePoint point{place.patch.face,
                   place.patch.center_in_world,
                   place.patch.normal_in_world,
                   {ObservationOf(place.patch, first, views[first.photograph].camera, itself)}};
    std::erase_if(place.viewers, [&](const PatchViewer& viewer) {
      const std::optional<ImageF> surroundings =
          flattened(viewer, options.patch_texels + 2 * options.search_texels);
      if (!surroundings) return false;
      const auto match = MatchPatch(*patch, *surroundings, options.match);
      matched.tried.emplace_back(first.photograph, match.has_value());
      matched.tried.emplace_back(viewer.photograph, match.has_value());
      if (!match) return false;
      point.observations.push_back(
          ObservationOf(place.patch, viewer, views[viewer.photograph].camera, *match));
      return true;
    });
    if (point.observations.size() > 1) matched.points.push_back(std::move(point));
  }
  return matched;
}

TiePoints MatchAtPlaces(const std::vector<PatchPlace>& places,
                        int num_stars,
                        const std::vector<TieView>& views,
                        const TieOptions& options) {
  std::vector<MatchedPlace> matched(places.size());
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    matched[i] = MatchAtPlace(places[i], num_stars, views, options);
  });
  TiePoints ties;
  ties.counts.resize(views.size());
  for (MatchedPlace& place : matched) {
    std::move(place.points.begin(), place.points.end(), std::back_inserter(ties.points));
    for (const auto& [photograph, is_found] : place.tried) {
      ++ties.counts[photograph].num_tried;
      ties.counts[photograph].num_matched += is_found;
    }
  }
  return ties;
}

}  // namespace

void TieOptions::Check(const std::string& path) const {
  CheckFromTo(grid_columns, 1, 1000, path + "grid_columns");
  CheckFromTo(patch_texels, 8, 256, path + "patch_texels");
  CheckFromTo(search_texels, 1, 256, path + "search_texels");
  CheckFromTo(least_resolution_share, 0, 1, path + "least_resolution_share");
  CheckFromTo(max_angle_deg, 0, 89, path + "max_angle_deg");
  CheckFromTo(num_stars, 1, 1000, path + "num_stars");
  CheckFromTo(num_levels, 1, 20, path + "num_levels");
  match.Check(path + "match.");
  tracks.Check(path + "tracks.");
}

TiePoints FindTiePoints(const PolygonModel& model,
                        const Visibility& visibility,
                        const std::vector<TieView>& views,
                        const TieOptions& options) {
  const PatchLayer layer(model, visibility, views, options);
  return MatchAtPlaces(layer.Lay(), options.num_stars, views, options);
}

TiePoints FindTiePointsOf(int photograph,
                          const PolygonModel& model,
                          const Visibility& visibility,
                          const std::vector<TieView>& views,
                          const TieOptions& options) {
  const PatchLayer layer(model, visibility, views, options);
  return MatchAtPlaces(layer.LayThrough(photograph), 1, views, options);
}

}  // namespace groundglass
