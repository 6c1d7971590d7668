// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/measure/texel_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace groundglass {
namespace {

// The texel that stands for a block: the most central one that has a face.
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
                  const SurfaceObservation& sighting,
                  double texel_size,
                  const BlockOptions& options) {
  CellView view;
  view.quality = static_cast<float>(photo.Quality(sighting));
  view.radius_squared = static_cast<float>(photo.RadiusSquared(sighting.image_px));
  // One tap at the level where the block is a pixel.
  const Eigen::Array3f radiance =
      pixels.Sample(sighting.image_px, sighting.px_from_unit * texel_size * kCellTexels, 1);
  view.is_usable = radiance.minCoeff() > options.black && radiance.maxCoeff() < options.burnt &&
                   sighting.border_px > options.clear_px;
  view.log_radiance = radiance.max(options.black / 4).log();
  return view;
}

// A chart's blocks on the way.
class CellObserver {
 public:
  CellObserver(const PolygonModel& model,
               const Chart& chart,
               int chart_index,
               const std::vector<PreparedPhoto>& photos)
      : chart_(chart), chart_index_(chart_index) {
    const ChartTexels texels(model, chart);
    cells_.width = (chart.width_texels + kCellTexels - 1) / kCellTexels;
    cells_.height = (chart.height_texels + kCellTexels - 1) / kCellTexels;
    cells_.photos = FindPhotosOfChart(chart, chart_index, photos);
    cells_.views.resize(cells_.photos.size() * cells_.NumCells());
    sees_.assign(cells_.photos.size(), 0);
    spots_.resize(cells_.NumCells());
    tbb::parallel_for(0, cells_.height, [&](int cell_y) {
      for (int cell_x = 0; cell_x < cells_.width; ++cell_x) {
        int x = 0;
        int y = 0;
        if (!FindTexel(texels, cell_x, cell_y, x, y)) continue;
        spots_[cell_y * cells_.width + cell_x] = {
            (chart.texel_size * texels.PointAt(x, y)).cast<float>(), texels.FaceAt(x, y)};
      }
    });
  }

  bool MaySee(int photo) const {
    return std::binary_search(cells_.photos.begin(), cells_.photos.end(), photo);
  }

  void Observe(int photo_index,
               const PreparedPhoto& photo,
               const PhotoPyramid& pixels,
               const BlockOptions& options) {
    const auto at = std::lower_bound(cells_.photos.begin(), cells_.photos.end(), photo_index);
    const size_t k = at - cells_.photos.begin();
    const size_t num_photos = cells_.photos.size();
    const ChartInCamera view = photo.View(chart_, chart_index_);
    std::vector<char> sees_row(cells_.height, 0);
    tbb::parallel_for(0, cells_.height, [&](int cell_y) {
      for (int block = cell_y * cells_.width; block < (cell_y + 1) * cells_.width; ++block) {
        const Spot& spot = spots_[block];
        if (spot.face < 0) continue;
        const auto sighting = photo.Observe(view, spot.plane_point.cast<double>(), spot.face);
        if (!sighting) continue;
        CellView& cell_view = cells_.views[block * num_photos + k];
        cell_view = ViewCell(photo, pixels, *sighting, chart_.texel_size, options);
        if (cell_view.quality > 0) sees_row[cell_y] = 1;
      }
    });
    sees_[k] = std::find(sees_row.begin(), sees_row.end(), 1) != sees_row.end();
  }

  // Photographs that see none of it are left out.
  ChartBlocks Finish() {
    const size_t num_photos = cells_.photos.size();
    size_t num_kept = 0;
    for (size_t i = 0; i < cells_.views.size(); ++i) {
      if (sees_[i % num_photos]) cells_.views[num_kept++] = cells_.views[i];
    }
    cells_.views.resize(num_kept);
    size_t k = 0;
    std::erase_if(cells_.photos, [&](int) { return !sees_[k++]; });
    return std::move(cells_);
  }

 private:
  struct Spot {
    Eigen::Vector2f plane_point;
    int face = -1;
  };
  const Chart& chart_;
  int chart_index_;
  ChartBlocks cells_;
  std::vector<char> sees_;
  std::vector<Spot> spots_;
};

}  // namespace

std::vector<int> FindPhotosOfChart(const Chart& chart,
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

std::vector<ChartBlocks> ObserveBlocks(const PolygonModel& model,
                                       const std::vector<Chart>& charts,
                                       const std::vector<PreparedPhoto>& photos,
                                       const BlockOptions& options) {
  const int num_charts = static_cast<int>(charts.size());
  std::vector<std::optional<CellObserver>> observers(charts.size());
  tbb::parallel_for(0, num_charts, [&](int i) {
    if (charts[i].page >= 0) observers[i].emplace(model, charts[i], i, photos);
  });
  // Backwards: those that were read last may still be in memory.
  for (int photo = static_cast<int>(photos.size()) - 1; photo >= 0; --photo) {
    std::shared_ptr<const PhotoPyramid> pixels;
    for (const std::optional<CellObserver>& observer : observers) {
      if (!pixels && observer && observer->MaySee(photo)) pixels = photos[photo].Pixels();
    }
    tbb::parallel_for(0, num_charts, [&](int i) {
      if (observers[i] && observers[i]->MaySee(photo)) {
        observers[i]->Observe(photo, photos[photo], *pixels, options);
      }
    });
  }
  std::vector<ChartBlocks> blocks(charts.size());
  tbb::parallel_for(0, num_charts, [&](int i) {
    if (observers[i]) blocks[i] = observers[i]->Finish();
    observers[i].reset();
  });
  return blocks;
}

}  // namespace groundglass
