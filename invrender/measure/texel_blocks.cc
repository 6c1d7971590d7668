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
bool FindTexel(const ChartTexels& texels, int block_x, int block_y, int& best_x, int& best_y) {
  constexpr double kCentre = (kBlockTexels - 1) / 2.0;
  double best = 1e300;
  for (int j = 0; j < kBlockTexels; ++j) {
    for (int i = 0; i < kBlockTexels; ++i) {
      const int x = block_x * kBlockTexels + i;
      const int y = block_y * kBlockTexels + j;
      if (x >= texels.width() || y >= texels.height() || texels.FaceAt(x, y) < 0) continue;
      const double distance =
          std::hypot(i - kCentre, j - kCentre) + (texels.IsCentreInside(x, y) ? 0 : kBlockTexels);
      if (distance < best) {
        best = distance;
        best_x = x;
        best_y = y;
      }
    }
  }
  return best < 1e300;
}

BlockView ViewBlock(const PreparedPhoto& photo,
                    const PhotoPyramid& pixels,
                    const SurfaceObservation& observation,
                    double texel_size,
                    const BlockOptions& options) {
  BlockView view;
  view.quality = static_cast<float>(photo.Quality(observation));
  view.radius_squared = static_cast<float>(photo.RadiusSquared(observation.image_px));
  // One tap at the level where the block is a pixel.
  const Eigen::Array3f radiance = pixels.Sample(
      observation.image_px, observation.px_from_unit * texel_size * kBlockTexels, kOneTap);
  view.is_usable = radiance.minCoeff() > options.black && radiance.maxCoeff() < options.burnt &&
                   observation.border_px > options.clear_px;
  view.log_radiance = radiance.max(options.black / 4).log();
  return view;
}

// A chart's blocks on the way.
class BlockObserver {
 public:
  BlockObserver(const PolygonModel& model,
                const Chart& chart,
                int chart_index,
                const std::vector<PreparedPhoto>& photos)
      : chart_(chart), chart_index_(chart_index) {
    const ChartTexels texels(model, chart);
    blocks_.width = (chart.width_texels + kBlockTexels - 1) / kBlockTexels;
    blocks_.height = (chart.height_texels + kBlockTexels - 1) / kBlockTexels;
    blocks_.photos = FindPhotosOfChart(chart, chart_index, photos);
    blocks_.views.resize(blocks_.photos.size() * blocks_.NumBlocks());
    sees_.assign(blocks_.photos.size(), 0);
    points_.resize(blocks_.NumBlocks());
    tbb::parallel_for(0, blocks_.height, [&](int block_y) {
      for (int block_x = 0; block_x < blocks_.width; ++block_x) {
        int x = 0;
        int y = 0;
        if (!FindTexel(texels, block_x, block_y, x, y)) continue;
        points_[block_y * blocks_.width + block_x] = {
            (chart.texel_size * texels.PointAt(x, y)).cast<float>(), texels.FaceAt(x, y)};
      }
    });
  }

  bool MaySee(int photo) const {
    return std::binary_search(blocks_.photos.begin(), blocks_.photos.end(), photo);
  }

  void Observe(int photo_index,
               const PreparedPhoto& photo,
               const PhotoPyramid& pixels,
               const BlockOptions& options) {
    const auto at = std::lower_bound(blocks_.photos.begin(), blocks_.photos.end(), photo_index);
    const size_t k = at - blocks_.photos.begin();
    const size_t num_photos = blocks_.photos.size();
    const ChartInCamera view = photo.View(chart_, chart_index_);
    std::vector<char> sees_row(blocks_.height, 0);
    tbb::parallel_for(0, blocks_.height, [&](int block_y) {
      for (int block = block_y * blocks_.width; block < (block_y + 1) * blocks_.width; ++block) {
        const SurfacePoint& point = points_[block];
        if (point.face < 0) continue;
        const auto observation = photo.Observe(view, point.plane_point.cast<double>(), point.face);
        if (!observation) continue;
        BlockView& block_view = blocks_.views[block * num_photos + k];
        block_view = ViewBlock(photo, pixels, *observation, chart_.texel_size, options);
        if (block_view.quality > 0) sees_row[block_y] = 1;
      }
    });
    sees_[k] = std::find(sees_row.begin(), sees_row.end(), 1) != sees_row.end();
  }

  // Photographs that see none of it are left out.
  ChartBlocks Finish() {
    const size_t num_photos = blocks_.photos.size();
    size_t num_kept = 0;
    for (size_t i = 0; i < blocks_.views.size(); ++i) {
      if (sees_[i % num_photos]) blocks_.views[num_kept++] = blocks_.views[i];
    }
    blocks_.views.resize(num_kept);
    size_t k = 0;
    std::erase_if(blocks_.photos, [&](int) { return !sees_[k++]; });
    return std::move(blocks_);
  }

 private:
  struct SurfacePoint {
    Eigen::Vector2f plane_point;
    int face = -1;
  };
  const Chart& chart_;
  int chart_index_;
  ChartBlocks blocks_;
  std::vector<char> sees_;
  std::vector<SurfacePoint> points_;
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
  std::vector<std::optional<BlockObserver>> observers(charts.size());
  tbb::parallel_for(0, num_charts, [&](int i) {
    if (charts[i].page >= 0) observers[i].emplace(model, charts[i], i, photos);
  });
  // Backwards: those that were read last may still be in memory.
  for (int photo = static_cast<int>(photos.size()) - 1; photo >= 0; --photo) {
    std::shared_ptr<const PhotoPyramid> pixels;
    for (const std::optional<BlockObserver>& observer : observers) {
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
