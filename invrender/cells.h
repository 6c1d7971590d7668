// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts.h"
#include "invrender/prepared_photo.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// Side of a cell in texels. Colour, consensus and choice are settled on cells; texels only follow.
constexpr int kCellTexels = 5;

// One cell as one photograph shows it.
struct CellView {
  float quality = 0;         // 0: not seen
  float radius_squared = 0;  // PreparedPhoto::RadiusSquared
  bool is_usable = false;    // neither burnt out nor black, and clear of borders
  Eigen::Array3f log_radiance = Eigen::Array3f::Zero();  // natural logarithm
};

// What every photograph shows of one chart, coarsely.
struct ChartCells {
  int width = 0;  // cells
  int height = 0;
  std::vector<int> photos;      // those that see some of the chart, ascending
  std::vector<CellView> views;  // [cell * photos.size() + k]

  int NumCells() const { return width * height; }
  const CellView* ViewsOf(int cell) const { return &views[cell * photos.size()]; }
};

// The photographs that may see some of the chart, ascending.
std::vector<int> FindPhotosOfChart(const Chart& chart,
                                   int chart_index,
                                   const std::vector<PreparedPhoto>& photos);

// Looks every cell of every chart up in every photograph, photograph by photograph, so that each is
// decoded once; charts that have no page stay empty.
std::vector<ChartCells> ObserveCells(const PolygonModel& model,
                                     const std::vector<Chart>& charts,
                                     const std::vector<PreparedPhoto>& photos);

}  // namespace groundglass
