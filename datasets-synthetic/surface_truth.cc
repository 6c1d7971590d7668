// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/surface_truth.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/frames.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace groundglass {
namespace {

// How far before a face a ray sets out, more than a sill sticks out; and how far it goes, more than
// a window lies deep. Feet.
constexpr double kBefore = 0.7;
constexpr double kReach = 2.2;
// What lies no farther before or behind a model's face that is drawn by itself is that face.
constexpr double kSameDepth = 0.3;

// A chart that holds a face, not yet on a page.
SurfaceChart FitChart(const PolygonModel& model, int face, double texel) {
  const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
  const bool is_level = std::abs(normal.z()) > 0.999;
  const Eigen::Vector3d right =
      is_level ? Eigen::Vector3d::UnitX() : Eigen::Vector3d(Eigen::Vector3d::UnitZ().cross(normal));
  SurfaceChart chart;
  chart.face = face;
  chart.step_right_in_world = texel * right.normalized();
  chart.step_down_in_world = is_level ? Eigen::Vector3d(-texel * Eigen::Vector3d::UnitY())
                                      : Eigen::Vector3d(chart.step_right_in_world.cross(normal));
  const Eigen::Vector3d origin = model.points_in_world[model.faces[face].points[0]];
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const int point : model.faces[face].points) {
    const Eigen::Vector3d offset = model.points_in_world[point] - origin;
    const Eigen::Vector2d at(offset.dot(chart.step_right_in_world),
                             offset.dot(chart.step_down_in_world));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  low /= texel * texel;
  high /= texel * texel;
  constexpr double kSame = 1e-6;  // texels: an edge that ends on the grid needs no further texel
  chart.width = std::max(1, static_cast<int>(std::ceil(high.x() - low.x() - kSame)));
  chart.height = std::max(1, static_cast<int>(std::ceil(high.y() - low.y() - kSame)));
  chart.corner_in_world =
      origin + low.x() * chart.step_right_in_world + low.y() * chart.step_down_in_world;
  return chart;
}

// The face's corners on its chart, in texels.
std::vector<Eigen::Vector2d> OutlineOnChart(const PolygonModel& model, const SurfaceChart& chart) {
  std::vector<Eigen::Vector2d> outline;
  for (const int point : model.faces[chart.face].points) {
    const Eigen::Vector3d offset = model.points_in_world[point] - chart.corner_in_world;
    outline.emplace_back(
        offset.dot(chart.step_right_in_world) / chart.step_right_in_world.squaredNorm(),
        offset.dot(chart.step_down_in_world) / chart.step_down_in_world.squaredNorm());
  }
  return outline;
}

// By the parity of the edges that a level line from the point crosses.
bool IsInside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& at) {
  bool is_inside = false;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > at.y()) == (b.y() > at.y())) continue;
    const double x = a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (at.x() < x) is_inside = !is_inside;
  }
  return is_inside;
}

// Fills one chart of a page.
class ChartPainter {
 public:
  ChartPainter(const SyntheticWorld& world,
               const PolygonModel& model,
               const Visibility& visibility,
               const SkyMap& sky_map,
               const Daylight& light,
               const SurfaceChart& chart)
      : world_(world),
        visibility_(visibility),
        sky_map_(sky_map),
        light_(light),
        chart_(chart),
        outline_(OutlineOnChart(model, chart)),
        normal_(ComputeFacePlane(model, chart.face).normal_in_world) {}

  void Paint(SurfacePage& page) const {
    std::vector<TexelKind> corner_kinds(static_cast<size_t>(chart_.width + 1) *
                                        (chart_.height + 1));
    const auto corner = [&](int column, int row) -> TexelKind& {
      return corner_kinds[static_cast<size_t>(row) * (chart_.width + 1) + column];
    };
    tbb::parallel_for(0, chart_.height + 1, [&](int row) {
      for (int column = 0; column <= chart_.width; ++column) {
        corner(column, row) = KindAt(column, row);
      }
    });
    tbb::parallel_for(0, chart_.height, [&](int row) {
      for (int column = 0; column < chart_.width; ++column) {
        TexelKind kind = corner(column, row);
        for (int i = 1; i < 4; ++i) {
          if (corner(column + i % 2, row + i / 2) != kind) kind = TexelKind::kEdge;
        }
        const bool is_on_face =
            kind == TexelKind::kExact || IsInside(outline_, {column + 0.5, row + 0.5});
        if (!is_on_face) continue;
        const int x = chart_.left + column;
        const int y = chart_.top + row;
        const Appearance mean =
            MeanOver(column, row, kind == TexelKind::kExact && !world_.is_model_apart);
        if (mean.gloss > 0 && kind != TexelKind::kEdge) kind = TexelKind::kGlass;
        *page.kinds.At(x, y) = static_cast<uint16_t>(kind);
        for (int c = 0; c < 3; ++c) page.radiance.At(x, y)[c] = mean.albedo[c];
      }
    });
  }

 private:
  // What comes first square on to the face.
  std::optional<Visibility::Hit> Ahead(double column, double row) const {
    return visibility_.FirstHit(
        chart_.PointInWorld(column, row) + kBefore * normal_, -normal_, 0, kBefore + kReach);
  }

  TexelKind KindAt(double column, double row) const {
    const auto hit = Ahead(column, row);
    if (!hit) return TexelKind::kNone;
    if (world_.surfaces[hit->face].is_relief) return TexelKind::kRelief;
    if (world_.is_model_apart) {
      return hit->face < world_.num_model_faces && std::abs(hit->distance - kBefore) < kSameDepth
                 ? TexelKind::kExact
                 : TexelKind::kEdge;
    }
    return hit->face == chart_.face ? TexelKind::kExact : TexelKind::kEdge;
  }

  // The mean of four quarters, each filtered over its own area: light that leaves in `albedo`.
  Appearance MeanOver(int column, int row, bool is_in_plane) const {
    const double width = chart_.step_right_in_world.norm() / 2;
    Appearance mean;
    for (int i = 0; i < 4; ++i) {
      const double at_column = column + 0.25 + 0.5 * (i % 2);
      const int half = i / 2;
      const double at_row = row + 0.25 + 0.5 * half;
      int face = chart_.face;
      Eigen::Vector3d point = chart_.PointInWorld(at_column, at_row);
      if (!is_in_plane) {
        const auto hit = Ahead(at_column, at_row);
        if (!hit && world_.is_model_apart) continue;
        if (hit) {
          face = hit->face;
          point += (kBefore - hit->distance) * normal_;
        }
      }
      const Surface& surface = world_.surfaces[face];
      const Eigen::Vector2d at = surface.TextureOf(point);
      const Appearance appearance = AppearanceAt(surface, at.x(), at.y(), width, width);
      const auto sky_share = static_cast<float>(sky_map_.SkyShare(surface, face, at.x(), at.y()));
      mean.albedo += appearance.albedo.cwiseProduct(IndirectIrradiance(light_, sky_share)) / 4;
      mean.gloss += appearance.gloss / 4;
    }
    return mean;
  }

  const SyntheticWorld& world_;
  const Visibility& visibility_;
  const SkyMap& sky_map_;
  const Daylight& light_;
  const SurfaceChart& chart_;
  std::vector<Eigen::Vector2d> outline_;
  Eigen::Vector3d normal_;
};

}  // namespace

void SurfaceTruthOptions::Check() const {
  CheckAbove(texel, 0, "surface truth options: texel");
  CheckFromTo(page_width_px, 1, 65536, "surface truth options: page_width_px");
  CheckFromTo(page_height_px, 1, 65536, "surface truth options: page_height_px");
}

std::vector<SurfaceChart> LayOutSurfaces(const PolygonModel& model,
                                         const SurfaceTruthOptions& options) {
  options.Check();
  std::vector<SurfaceChart> charts;
  int page_width = options.page_width_px;
  int page_height = options.page_height_px;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    charts.push_back(FitChart(model, face, options.texel));
    page_width = std::max(page_width, charts.back().width);
    page_height = std::max(page_height, charts.back().height);
  }
  std::vector<int> tallest_first(charts.size());
  std::iota(tallest_first.begin(), tallest_first.end(), 0);
  std::stable_sort(tallest_first.begin(), tallest_first.end(), [&](int a, int b) {
    return charts[a].height > charts[b].height;
  });
  constexpr int kGap = 1;  // px, black between charts
  int page = 0;
  int left = 0;
  int top = 0;
  int shelf_height = 0;
  for (const int i : tallest_first) {
    SurfaceChart& chart = charts[i];
    if (left + chart.width > page_width) {
      left = 0;
      top += shelf_height + kGap;
      shelf_height = 0;
    }
    if (top + chart.height > page_height) {
      ++page;
      left = top = shelf_height = 0;
    }
    chart.page = page;
    chart.left = left;
    chart.top = top;
    left += chart.width + kGap;
    shelf_height = std::max(shelf_height, chart.height);
  }
  return charts;
}

SurfacePage RenderSurfacePage(const SyntheticWorld& world,
                              const PolygonModel& model,
                              const Visibility& visibility,
                              const SkyMap& sky_map,
                              const Daylight& light,
                              const std::vector<SurfaceChart>& charts,
                              int page) {
  int width = 0;
  int height = 0;
  for (const SurfaceChart& chart : charts) {
    if (chart.page != page) continue;
    width = std::max(width, chart.left + chart.width);
    height = std::max(height, chart.top + chart.height);
  }
  SurfacePage result{ImageF(width, height, 3), Image16(width, height, 1)};
  for (const SurfaceChart& chart : charts) {
    if (chart.page != page) continue;
    ChartPainter(world, model, visibility, sky_map, light, chart).Paint(result);
  }
  return result;
}

void WriteSurfaces(const std::filesystem::path& folder,
                   const SyntheticWorld& world,
                   const PolygonModel& model,
                   const Visibility& visibility,
                   const SkyMap& sky_map,
                   const Daylight& light,
                   const SurfaceTruthOptions& options) {
  const std::vector<SurfaceChart> charts = LayOutSurfaces(model, options);
  int num_pages = 0;
  for (const SurfaceChart& chart : charts) num_pages = std::max(num_pages, chart.page + 1);
  for (int page = 0; page < num_pages; ++page) {
    WriteSurfacePage(
        folder, page, RenderSurfacePage(world, model, visibility, sky_map, light, charts, page));
  }
  WriteFileAtomically(folder / "charts.csv", FormatCharts(charts));
}

}  // namespace groundglass
