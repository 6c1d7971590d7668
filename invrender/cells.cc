// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

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

CellView ViewCell(const PreparedPhoto& photo,
                  const PhotoPyramid& pixels,
                  const Sighting& sighting,
                  double texel_size) {
  constexpr float kBlack = 0.002f;
  constexpr float kBurnt = 0.93f;
  CellView view;
  view.quality = static_cast<float>(photo.Quality(sighting));
  view.radius_squared = static_cast<float>(photo.RadiusSquared(sighting.image_px));
  // One tap at the level where the cell is a pixel.
  const Eigen::Array3f radiance =
      pixels.Sample(sighting.image_px, sighting.px_from_unit * texel_size * kCellTexels, 1);
  view.is_usable =
      radiance.minCoeff() > kBlack && radiance.maxCoeff() < kBurnt && sighting.border_px > 2;
  view.log_radiance = radiance.max(kBlack / 4).log();
  return view;
}

// The photographs that may see some of the chart.
std::vector<int> FindCandidates(const Chart& chart,
                                int chart_index,
                                const std::vector<PreparedPhoto>& photos) {
  std::vector<int> facing;
  std::vector<int> showing;
  for (size_t photo = 0; photo < photos.size(); ++photo) {
    if (!photos[photo].View(chart, chart_index).is_facing) continue;
    facing.push_back(static_cast<int>(photo));
    const bool shows = std::any_of(chart.faces.begin(), chart.faces.end(), [&](int face) {
      return photos[photo].Shows(face);
    });
    if (shows) showing.push_back(static_cast<int>(photo));
  }
  // A sliver that falls between all photographs' pixels is still seen between them.
  return showing.empty() ? facing : showing;
}

// Where a cell is looked up.
struct CellSpot {
  Eigen::Vector2d plane_point;
  int face = -1;
};

}  // namespace

ChartCells ObserveCells(const Chart& chart,
                        int chart_index,
                        const ChartTexels& texels,
                        const std::vector<PreparedPhoto>& photos) {
  ChartCells cells;
  cells.width = (chart.width_texels + kCellTexels - 1) / kCellTexels;
  cells.height = (chart.height_texels + kCellTexels - 1) / kCellTexels;
  std::vector<CellSpot> spots(cells.NumCells());
  tbb::parallel_for(0, cells.height, [&](int cell_y) {
    for (int cell_x = 0; cell_x < cells.width; ++cell_x) {
      int x = 0;
      int y = 0;
      if (!FindTexel(texels, cell_x, cell_y, x, y)) continue;
      spots[cell_y * cells.width + cell_x] = {chart.texel_size * texels.PointAt(x, y),
                                              texels.FaceAt(x, y)};
    }
  });
  const std::vector<int> candidates = FindCandidates(chart, chart_index, photos);
  const size_t num_candidates = candidates.size();
  std::vector<CellView> all(num_candidates * cells.NumCells());
  std::vector<char> sees(num_candidates, 0);
  for (size_t k = 0; k < num_candidates; ++k) {
    const PreparedPhoto& photo = photos[candidates[k]];
    const ChartInCamera view = photo.View(chart, chart_index);
    const std::shared_ptr<const PhotoPyramid> pixels = photo.Pixels();
    std::vector<char> sees_row(cells.height, 0);
    tbb::parallel_for(0, cells.height, [&](int cell_y) {
      for (int cell = cell_y * cells.width; cell < (cell_y + 1) * cells.width; ++cell) {
        if (spots[cell].face < 0) continue;
        const auto sighting = photo.Sight(view, spots[cell].plane_point, spots[cell].face);
        if (!sighting) continue;
        CellView& cell_view = all[cell * num_candidates + k];
        cell_view = ViewCell(photo, *pixels, *sighting, chart.texel_size);
        if (cell_view.quality > 0) sees_row[cell_y] = 1;
      }
    });
    sees[k] = std::find(sees_row.begin(), sees_row.end(), 1) != sees_row.end();
  }
  for (size_t k = 0; k < num_candidates; ++k) {
    if (sees[k]) cells.photos.push_back(candidates[k]);
  }
  if (cells.photos.size() == num_candidates) {
    cells.views = std::move(all);
    return cells;
  }
  cells.views.reserve(cells.photos.size() * cells.NumCells());
  for (size_t i = 0; i < all.size(); ++i) {
    if (sees[i % num_candidates]) cells.views.push_back(all[i]);
  }
  return cells;
}

}  // namespace groundglass
