// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/measure/texel_size.h"

#include "invrender/charts/spread_points.h"
#include "invrender/measure/texel_blocks.h"
#include "scene/quantile.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {

void ChooseTexelSizes(const PolygonModel& model,
                      const std::vector<PreparedPhoto>& photos,
                      const PageOptions& options,
                      std::vector<Chart>& charts) {
  const int room = options.max_page_texels - 2 * options.gutter_texels;
  tbb::parallel_for(size_t{0}, charts.size(), [&](size_t index) {
    Chart& chart = charts[index];
    chart.texel_size = 0;
    const std::vector<int> seeing = FindPhotosOfChart(chart, static_cast<int>(index), photos);
    std::vector<ChartInCamera> views;
    for (const int photo : seeing) {
      views.push_back(photos[photo].View(chart, static_cast<int>(index)));
    }
    std::vector<double> best_resolutions;
    for (const int face : chart.faces) {
      for (const Eigen::Vector3d& point : SpreadPoints(model, face)) {
        double best = 0;
        for (size_t i = 0; i < seeing.size(); ++i) {
          const auto observation =
              photos[seeing[i]].Observe(views[i], chart.PlanePoint(point), face);
          if (!observation) continue;
          best = std::max(best, std::sqrt(std::abs(observation->px_from_unit.determinant())));
        }
        if (best > 0) best_resolutions.push_back(best);
      }
    }
    if (best_resolutions.empty()) return;
    const size_t rank =
        static_cast<size_t>(options.kept_share * static_cast<double>(best_resolutions.size() - 1));
    double size = options.texel_size > 0
                      ? options.texel_size
                      : options.texel_px / ValueOfRank(std::move(best_resolutions), rank);
    size = std::max(size, std::max(chart.width, chart.height) / room);
    chart.SetTexelSize(size);
  });
}

}  // namespace groundglass
