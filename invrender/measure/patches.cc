// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/measure/patches.h"

#include "invrender/charts/spread_points.h"
#include "invrender/photos/srgb_codes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace groundglass {
namespace {

Eigen::Vector2d SampleInPlane(const Patch& patch, double row, double column) {
  return patch.corner_in_plane + patch.step * Eigen::Vector2d(column, row);
}

// One on each of the points that SpreadPoints gives, thinned out evenly; corner_in_plane is the
// patch's middle for now.
std::vector<Patch> SpreadPatches(const PolygonModel& model,
                                 const std::vector<Chart>& charts,
                                 const PatchOptions& options) {
  std::vector<Patch> patches;
  for (size_t chart = 0; chart < charts.size(); ++chart) {
    for (const int face : charts[chart].faces) {
      for (const Eigen::Vector3d& point : SpreadPoints(model, face)) {
        Patch& patch = patches.emplace_back();
        patch.chart = static_cast<int>(chart);
        patch.face = face;
        patch.corner_in_plane = charts[chart].PlanePoint(point);
      }
    }
  }
  const auto num_kept = static_cast<size_t>(options.max_patches);
  if (patches.size() <= num_kept) return patches;
  std::vector<Patch> kept;
  for (size_t i = 0; i < num_kept; ++i) kept.push_back(patches[i * patches.size() / num_kept]);
  return kept;
}

bool ShowsWhole(const PreparedPhoto& photo,
                const ChartInCamera& in_camera,
                const Patch& patch,
                const PatchOptions& options) {
  constexpr double kLast = kPatchSide - 1;
  for (const double row : {0.0, kLast / 2, kLast}) {
    for (const double column : {0.0, kLast / 2, kLast}) {
      const auto observation =
          photo.Observe(in_camera, SampleInPlane(patch, row, column), patch.face);
      if (!observation || observation->border_px < options.clear_px) return false;
    }
  }
  return true;
}

// Settles the patch's place and who shows it; no views if fewer than two do.
void FindViews(const std::vector<Chart>& charts,
               const std::vector<PreparedPhoto>& photos,
               const PatchOptions& options,
               Patch& patch) {
  const Eigen::Vector2d middle = patch.corner_in_plane;
  const auto in_camera = [&](int photo) {
    return photos[photo].View(charts[patch.chart], patch.chart);
  };
  std::vector<PatchView> views;  // of hundreds of photographs, so that the patch keeps a few only
  for (int photo = 0; photo < static_cast<int>(photos.size()); ++photo) {
    const auto observation = photos[photo].Observe(in_camera(photo), middle, patch.face);
    if (!observation || observation->border_px < options.clear_px) continue;
    const double px_per_unit = std::sqrt(std::abs(observation->px_from_unit.determinant()));
    if (!(px_per_unit > 0)) continue;
    PatchView& view = views.emplace_back();
    view.photo = photo;
    view.px_per_unit = px_per_unit;
    view.step_from_px = px_per_unit * observation->px_from_unit.inverse();
  }
  if (views.size() < 2) return;
  std::stable_sort(views.begin(), views.end(), [](const auto& a, const auto& b) {
    return a.px_per_unit > b.px_per_unit;
  });
  const double best = views.front().px_per_unit;
  patch.step = 1 / best;
  patch.corner_in_plane = middle - Eigen::Vector2d::Constant(patch.step * (kPatchSide - 1) / 2);
  for (PatchView& view : views) view.step_from_px *= best / view.px_per_unit;
  std::erase_if(views, [&](const PatchView& view) {
    return view.px_per_unit * options.max_coarseness < best ||
           !ShowsWhole(photos[view.photo], in_camera(view.photo), patch, options);
  });
  if (views.size() < 2) return;
  views.resize(std::min(views.size(), static_cast<size_t>(options.max_views)));
  patch.views.assign(views.begin(), views.end());
}

PatchSamples SamplePatch(const Chart& chart,
                         const PreparedPhoto& photo,
                         const PhotoPyramid& pixels,
                         const Patch& patch) {
  const ChartInCamera in_camera = photo.View(chart, patch.chart);
  PatchSamples samples;
  for (int y = 0; y < kPatchSide; ++y) {
    for (int x = 0; x < kPatchSide; ++x) {
      const Eigen::Vector2d image_px = photo.Locate(in_camera, SampleInPlane(patch, y, x));
      const Eigen::Array3f radiance = pixels.Sample(image_px, Eigen::Matrix2d::Zero(), kOneTap);
      samples(y, x) =
          Srgb16FromRadiance(std::min(1.0f, Luma(radiance[0], radiance[1], radiance[2])));
    }
  }
  return samples;
}

}  // namespace

std::vector<Patch> SamplePatches(const PolygonModel& model,
                                 const std::vector<Chart>& charts,
                                 const std::vector<PreparedPhoto>& photos,
                                 const PatchOptions& options) {
  std::vector<Patch> patches = SpreadPatches(model, charts, options);
  tbb::parallel_for(
      size_t{0}, patches.size(), [&](size_t i) { FindViews(charts, photos, options, patches[i]); });
  std::erase_if(patches, [](const Patch& patch) { return patch.views.empty(); });
  for (int photo = 0; photo < static_cast<int>(photos.size()); ++photo) {
    std::vector<std::pair<const Patch*, PatchView*>> wanted;
    for (Patch& patch : patches) {
      for (PatchView& view : patch.views) {
        if (view.photo == photo) wanted.emplace_back(&patch, &view);
      }
    }
    if (wanted.empty()) continue;
    const std::shared_ptr<const PhotoPyramid> pixels = photos[photo].Pixels();
    tbb::parallel_for(size_t{0}, wanted.size(), [&](size_t i) {
      const auto& [patch, view] = wanted[i];
      view->luma = SamplePatch(charts[patch->chart], photos[photo], *pixels, *patch);
    });
  }
  return patches;
}

}  // namespace groundglass
