// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/texel_errors.h"

#include "datasets-synthetic/surface_truth.h"
#include "evaluate/texel_map.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

double Levels(double linear) {
  return 255.0 * SrgbFromLinear(std::clamp(static_cast<float>(linear), 0.0f, 1.0f));
}

// Linear light between the middles of a page's texels.
Eigen::Vector3d LightAt(const Image8& page, const Eigen::Vector2d& at) {
  const std::array<float, 256>& light = LinearOfSrgb8();
  const double x = std::clamp(at.x() - 0.5, 0.0, page.width - 1.0);
  const double y = std::clamp(at.y() - 0.5, 0.0, page.height - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(0, page.width - 2));
  const int y0 = std::min(static_cast<int>(y), std::max(0, page.height - 2));
  const int x1 = std::min(x0 + 1, page.width - 1);
  const int y1 = std::min(y0 + 1, page.height - 1);
  Eigen::Vector3d result;
  for (int c = 0; c < 3; ++c) {
    const auto value = [&](int column, int row) {
      return static_cast<double>(light[page.At(column, row)[c]]);
    };
    result[c] = std::lerp(std::lerp(value(x0, y0), value(x1, y0), x - x0),
                          std::lerp(value(x0, y1), value(x1, y1), x - x0),
                          y - y0);
  }
  return result;
}

// Sums over a face's covered texels, from which its error follows for any gain.
struct FaceSums {
  long num_texels = 0;
  long num_covered = 0;
  Eigen::Vector3d truth_squared = Eigen::Vector3d::Zero();
  Eigen::Vector3d found_squared = Eigen::Vector3d::Zero();
  Eigen::Vector3d product = Eigen::Vector3d::Zero();

  void Add(const Eigen::Vector3d& truth, const Eigen::Vector3d& found) {
    ++num_covered;
    truth_squared += truth.cwiseAbs2();
    found_squared += found.cwiseAbs2();
    product += truth.cwiseProduct(found);
  }
  // Sum over channels of (gain found - truth)^2.
  double SquaredError(const Eigen::Vector3d& gain) const {
    return (gain.cwiseAbs2().cwiseProduct(found_squared) - 2 * gain.cwiseProduct(product) +
            truth_squared)
        .sum();
  }
};

bool IsFromPhotograph(const TexturePage& page, const Eigen::Vector2d& at) {
  if (page.provenance.Empty()) return true;
  const int x = std::clamp(static_cast<int>(at.x()), 0, page.provenance.width - 1);
  const int y = std::clamp(static_cast<int>(at.y()), 0, page.provenance.height - 1);
  const uint16_t origin = *page.provenance.At(x, y);
  return origin != kProvenanceNone && origin != kProvenanceFilled;
}

FaceSums CompareChart(const TexturedModel& model,
                      const SurfaceChart& chart,
                      const SurfacePage& truth) {
  constexpr int kSamplesAcross = 4;  // each way, over one texel of the truth
  FaceSums sums;
  TexelMap map;
  if (chart.face < static_cast<int>(model.faces.size())) {
    map = FitTexelMap(model.model, chart.face, model.faces[chart.face]);
  }
  for (int row = 0; row < chart.height; ++row) {
    for (int column = 0; column < chart.width; ++column) {
      const int x = chart.left + column;
      const int y = chart.top + row;
      if (*truth.kinds.At(x, y) != static_cast<uint16_t>(TexelKind::kExact)) continue;
      ++sums.num_texels;
      if (!map.has_texture) continue;
      const TexturePage& page = model.pages[model.faces[chart.face].page];
      const auto texel_at = [&](double across, double down) {
        return map.TexelAt(chart.PointInWorld(column + across, row + down));
      };
      if (!IsFromPhotograph(page, texel_at(0.5, 0.5))) continue;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int j = 0; j < kSamplesAcross; ++j) {
        for (int i = 0; i < kSamplesAcross; ++i) {
          sum +=
              LightAt(page.srgb8, texel_at((i + 0.5) / kSamplesAcross, (j + 0.5) / kSamplesAcross));
        }
      }
      const float* radiance = truth.radiance.At(x, y);
      sums.Add({Levels(radiance[0]), Levels(radiance[1]), Levels(radiance[2])},
               (sum / (kSamplesAcross * kSamplesAcross)).unaryExpr(&Levels));
    }
  }
  return sums;
}

}  // namespace

TexelErrors MeasureTexels(const TexturedModel& model,
                          const std::filesystem::path& surfaces_folder) {
  const std::vector<SurfaceChart> charts = ReadCharts(surfaces_folder);
  std::vector<FaceSums> sums(charts.size());
  int num_pages = 0;
  for (const SurfaceChart& chart : charts) num_pages = std::max(num_pages, chart.page + 1);
  for (int page = 0; page < num_pages; ++page) {
    const SurfacePage truth = ReadSurfacePage(surfaces_folder, page);
    for (const SurfaceChart& chart : charts) {
      if (chart.page != page || (chart.left + chart.width <= truth.radiance.width &&
                                 chart.top + chart.height <= truth.radiance.height)) {
        continue;
      }
      throw Error(surfaces_folder / "charts.csv",
                  "face " + std::to_string(chart.face + 1) + " lies beyond its page");
    }
    tbb::parallel_for(size_t{0}, charts.size(), [&](size_t i) {
      if (charts[i].page == page) sums[i] = CompareChart(model, charts[i], truth);
    });
  }
  TexelErrors errors;
  errors.faces.resize(model.model.faces.size());
  FaceSums all;
  for (const FaceSums& of_face : sums) {
    errors.num_texels += of_face.num_texels;
    errors.num_covered += of_face.num_covered;
    all.found_squared += of_face.found_squared;
    all.product += of_face.product;
  }
  Eigen::Vector3d gain = Eigen::Vector3d::Ones();
  for (int c = 0; c < 3; ++c) {
    if (all.found_squared[c] > 0) gain[c] = all.product[c] / all.found_squared[c];
    errors.gain[c] = gain[c];
  }
  const auto root_mean = [](double squares, long count) {
    return count == 0 ? 0.0
                      : std::sqrt(std::max(0.0, squares) / (3.0 * static_cast<double>(count)));
  };
  double squares = 0;
  for (size_t i = 0; i < charts.size(); ++i) {
    const double of_face = sums[i].SquaredError(gain);
    squares += of_face;
    if (charts[i].face >= static_cast<int>(errors.faces.size())) continue;
    errors.faces[charts[i].face] = {
        sums[i].num_texels, sums[i].num_covered, root_mean(of_face, sums[i].num_covered)};
  }
  errors.rms_levels = root_mean(squares, errors.num_covered);
  return errors;
}

}  // namespace groundglass
