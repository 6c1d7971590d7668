// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/fine_detail.h"

#include "invrender/texel_size.h"
#include "scene/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace groundglass {
namespace {

constexpr size_t kMostSpots = 3000;
constexpr size_t kMostViews = 6;
// Pixels longer than this many of the best photograph's say little of fine detail.
constexpr double kCoarsest = 2;
constexpr double kClearPx = 3;  // of borders

Eigen::Vector2d SampleInPlane(const Spot& spot, double row, double column) {
  return spot.corner_in_plane + spot.step * Eigen::Vector2d(column, row);
}

// One on each of the points that SpreadPoints gives, thinned out evenly; corner_in_plane is the
// spot's middle for now.
std::vector<Spot> SpreadSpots(const PolygonModel& model, const std::vector<Chart>& charts) {
  std::vector<Spot> spots;
  for (size_t chart = 0; chart < charts.size(); ++chart) {
    for (const int face : charts[chart].faces) {
      for (const Eigen::Vector3d& point : SpreadPoints(model, face)) {
        Spot& spot = spots.emplace_back();
        spot.chart = static_cast<int>(chart);
        spot.face = face;
        spot.corner_in_plane = charts[chart].PlanePoint(point);
      }
    }
  }
  if (spots.size() <= kMostSpots) return spots;
  std::vector<Spot> kept;
  for (size_t i = 0; i < kMostSpots; ++i) kept.push_back(spots[i * spots.size() / kMostSpots]);
  return kept;
}

bool ShowsWhole(const PreparedPhoto& photo, const ChartInCamera& in_camera, const Spot& spot) {
  constexpr double kLast = kSpotSide - 1;
  for (const double row : {0.0, kLast / 2, kLast}) {
    for (const double column : {0.0, kLast / 2, kLast}) {
      const auto sighting = photo.Sight(in_camera, SampleInPlane(spot, row, column), spot.face);
      if (!sighting || sighting->border_px < kClearPx) return false;
    }
  }
  return true;
}

// Settles the spot's place and who shows it; no views if fewer than two do.
void FindViews(const std::vector<Chart>& charts,
               const std::vector<PreparedPhoto>& photos,
               Spot& spot) {
  const Eigen::Vector2d middle = spot.corner_in_plane;
  const auto in_camera = [&](int photo) {
    return photos[photo].View(charts[spot.chart], spot.chart);
  };
  std::vector<SpotView> views;  // of hundreds of photographs, so that the spot keeps a few only
  for (int photo = 0; photo < static_cast<int>(photos.size()); ++photo) {
    const auto sighting = photos[photo].Sight(in_camera(photo), middle, spot.face);
    if (!sighting || sighting->border_px < kClearPx) continue;
    const double px_per_unit = std::sqrt(std::abs(sighting->px_from_unit.determinant()));
    if (!(px_per_unit > 0)) continue;
    SpotView& view = views.emplace_back();
    view.photo = photo;
    view.px_per_unit = px_per_unit;
    view.step_from_px = px_per_unit * sighting->px_from_unit.inverse();
  }
  if (views.size() < 2) return;
  std::stable_sort(views.begin(), views.end(), [](const auto& a, const auto& b) {
    return a.px_per_unit > b.px_per_unit;
  });
  const double best = views.front().px_per_unit;
  spot.step = 1 / best;
  spot.corner_in_plane = middle - Eigen::Vector2d::Constant(spot.step * (kSpotSide - 1) / 2);
  for (SpotView& view : views) view.step_from_px *= best / view.px_per_unit;
  std::erase_if(views, [&](const SpotView& view) {
    return view.px_per_unit * kCoarsest < best ||
           !ShowsWhole(photos[view.photo], in_camera(view.photo), spot);
  });
  if (views.size() < 2) return;
  if (views.size() > kMostViews) views.resize(kMostViews);
  spot.views.assign(views.begin(), views.end());
}

SpotSamples LookAtSpot(const Chart& chart,
                       const PreparedPhoto& photo,
                       const PhotoPyramid& pixels,
                       const Spot& spot) {
  const ChartInCamera in_camera = photo.View(chart, spot.chart);
  const Eigen::Array3f luma(0.2126f, 0.7152f, 0.0722f);
  SpotSamples samples;
  for (int y = 0; y < kSpotSide; ++y) {
    for (int x = 0; x < kSpotSide; ++x) {
      const Eigen::Vector2d image_px = photo.Locate(in_camera, SampleInPlane(spot, y, x));
      const Eigen::Array3f radiance = pixels.Sample(image_px, Eigen::Matrix2d::Zero(), 1);
      samples(y, x) = Srgb16FromRadiance(std::min(1.0f, (radiance * luma).sum()));
    }
  }
  return samples;
}

}  // namespace

std::vector<Spot> LookAtSpots(const PolygonModel& model,
                              const std::vector<Chart>& charts,
                              const std::vector<PreparedPhoto>& photos) {
  std::vector<Spot> spots = SpreadSpots(model, charts);
  tbb::parallel_for(
      size_t{0}, spots.size(), [&](size_t i) { FindViews(charts, photos, spots[i]); });
  std::erase_if(spots, [](const Spot& spot) { return spot.views.empty(); });
  for (int photo = 0; photo < static_cast<int>(photos.size()); ++photo) {
    std::vector<std::pair<const Spot*, SpotView*>> wanted;
    for (Spot& spot : spots) {
      for (SpotView& view : spot.views) {
        if (view.photo == photo) wanted.emplace_back(&spot, &view);
      }
    }
    if (wanted.empty()) continue;
    const std::shared_ptr<const PhotoPyramid> pixels = photos[photo].Pixels();
    tbb::parallel_for(size_t{0}, wanted.size(), [&](size_t i) {
      const auto& [spot, view] = wanted[i];
      view->luma = LookAtSpot(charts[spot->chart], photos[photo], *pixels, *spot);
    });
  }
  return spots;
}

Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& normal,
                             const Eigen::VectorXd& right,
                             double least) {
  constexpr int kRounds = 200;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(right.size(), least);
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double rest = right[i] - normal.col(i).dot(x);
      x[i] = std::max(least, x[i] + rest / normal(i, i));
    }
  }
  return x;
}

}  // namespace groundglass
