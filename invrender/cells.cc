// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// The texel that stands for a cell: the most central one that has a face.
bool FindTexel(const ChartTexels& texels, int cell_x, int cell_y, int& best_x, int& best_y) {
  constexpr double kCentre = (kCellTexels - 1) / 2.0;
  double best = 1e300;
  for (int j = 0; j < kCellTexels; ++j) {
    for (int i = 0; i < kCellTexels; ++i) {
      const int x = cell_x * kCellTexels + i;
      const int y = cell_y * kCellTexels + j;
      if (x >= texels.width() || y >= texels.height() || texels.FaceAt(x, y) < 0) continue;
      const double distance =
          std::hypot(i - kCentre, j - kCentre) + (texels.IsCentreInside(x, y) ? 0 : kCellTexels);
      if (distance < best) {
        best = distance;
        best_x = x;
        best_y = y;
      }
    }
  }
  return best < 1e300;
}

CellView ViewCell(const PreparedPhoto& photo, const Sighting& sighting, double texel_size) {
  constexpr float kBlack = 0.002f;
  constexpr float kBurnt = 0.93f;
  CellView view;
  view.quality = static_cast<float>(sighting.quality);
  view.radius_squared = static_cast<float>(photo.RadiusSquared(sighting.image_px));
  const Eigen::Array3f radiance = photo.Sample(sighting, texel_size * kCellTexels, 2);
  view.is_usable =
      radiance.minCoeff() > kBlack && radiance.maxCoeff() < kBurnt && sighting.border_px > 2;
  view.log_radiance = radiance.max(kBlack / 4).log();
  return view;
}

}  // namespace

ChartCells ObserveCells(const Chart& chart,
                        int chart_index,
                        const ChartTexels& texels,
                        const std::vector<PreparedPhoto>& photos) {
  ChartCells cells;
  cells.width = (chart.width_texels + kCellTexels - 1) / kCellTexels;
  cells.height = (chart.height_texels + kCellTexels - 1) / kCellTexels;
  cells.is_inside.assign(cells.NumCells(), 0);
  const size_t num_photos = photos.size();
  std::vector<CellView> all(num_photos * cells.NumCells());
  tbb::parallel_for(0, cells.height, [&](int cell_y) {
    for (int cell_x = 0; cell_x < cells.width; ++cell_x) {
      int x = 0;
      int y = 0;
      if (!FindTexel(texels, cell_x, cell_y, x, y)) continue;
      const int cell = cell_y * cells.width + cell_x;
      cells.is_inside[cell] = 1;
      const Eigen::Vector3d point = chart.PointInWorld(texels.PointAt(x, y));
      for (size_t photo = 0; photo < num_photos; ++photo) {
        const auto sighting = photos[photo].Sight(point, chart, chart_index, texels.FaceAt(x, y));
        if (!sighting) continue;
        all[cell * num_photos + photo] = ViewCell(photos[photo], *sighting, chart.texel_size);
      }
    }
  });
  std::vector<char> sees(num_photos, 0);
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i].quality > 0) sees[i % num_photos] = 1;
  }
  for (size_t photo = 0; photo < num_photos; ++photo) {
    if (sees[photo]) cells.photos.push_back(static_cast<int>(photo));
  }
  cells.views.reserve(cells.photos.size() * cells.NumCells());
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    for (const int photo : cells.photos) cells.views.push_back(all[cell * num_photos + photo]);
  }
  return cells;
}

}  // namespace groundglass
