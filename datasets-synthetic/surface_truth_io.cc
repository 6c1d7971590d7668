// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/surface_truth.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr const char* kChartColumns =
    "face,page,left,top,width,height,x,y,z,right_x,right_y,right_z,down_x,down_y,down_z";

fs::path PageFile(const fs::path& folder, const char* what, int page) {
  return folder / (std::string(what) + "_" + std::to_string(page) + ".png");
}

}  // namespace

std::string FormatCharts(const std::vector<SurfaceChart>& charts) {
  std::string text = std::string(kChartColumns) + "\n";
  for (const SurfaceChart& chart : charts) {
    text += fmt::format("{},{},{},{},{},{}",
                        chart.face + 1,
                        chart.page,
                        chart.left,
                        chart.top,
                        chart.width,
                        chart.height);
    for (const Eigen::Vector3d& in_world :
         {chart.corner_in_world, chart.step_right_in_world, chart.step_down_in_world}) {
      const Eigen::Vector3d in_site = SiteFromWorld(in_world);
      // Adding zero turns a mirrored -0 into 0.
      for (int i = 0; i < 3; ++i) text += "," + FormatNumber(in_site[i] + 0.0);
    }
    text += "\n";
  }
  return text;
}

std::vector<SurfaceChart> ReadCharts(const fs::path& surfaces_folder) {
  const fs::path file = surfaces_folder / "charts.csv";
  std::string text = ReadTextFile(file);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<SurfaceChart> charts;
  for (const TextLine& line : SplitLines(text)) {
    if (line.number == 1 || line.tokens.empty()) continue;
    std::vector<double> numbers;
    for (const TextToken& token : line.tokens) {
      const auto number = ParseNumber(token.text);
      if (number && std::isfinite(*number)) numbers.push_back(*number);
    }
    const bool is_complete = numbers.size() == 15 && line.tokens.size() == 15;
    if (!is_complete || numbers[0] < 1 || *std::min_element(&numbers[1], &numbers[6]) < 0) {
      throw Error(
          file, line.number, std::string("expected ") + kChartColumns + ", the face from 1");
    }
    SurfaceChart chart;
    chart.face = static_cast<int>(numbers[0]) - 1;
    chart.page = static_cast<int>(numbers[1]);
    chart.left = static_cast<int>(numbers[2]);
    chart.top = static_cast<int>(numbers[3]);
    chart.width = static_cast<int>(numbers[4]);
    chart.height = static_cast<int>(numbers[5]);
    chart.corner_in_world = WorldFromSite({numbers[6], numbers[7], numbers[8]});
    chart.step_right_in_world = WorldFromSite({numbers[9], numbers[10], numbers[11]});
    chart.step_down_in_world = WorldFromSite({numbers[12], numbers[13], numbers[14]});
    charts.push_back(chart);
  }
  return charts;
}

SurfacePage ReadSurfacePage(const fs::path& surfaces_folder, int page) {
  SurfacePage result{ReadRadiance(PageFile(surfaces_folder, "page", page)),
                     ReadLabels(PageFile(surfaces_folder, "kinds", page))};
  if (result.radiance.width != result.kinds.width ||
      result.radiance.height != result.kinds.height) {
    throw Error(PageFile(surfaces_folder, "kinds", page), "not of its page's size");
  }
  return result;
}

void WriteSurfacePage(const fs::path& surfaces_folder, int page, const SurfacePage& surfaces) {
  WriteRadiance(PageFile(surfaces_folder, "page", page), surfaces.radiance, {.bits = 16});
  WriteLabels(PageFile(surfaces_folder, "kinds", page), surfaces.kinds);
}

}  // namespace groundglass
