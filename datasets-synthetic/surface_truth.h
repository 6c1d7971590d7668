// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/daylight.h"
#include "datasets-synthetic/synthetic_world.h"
#include "scene/image.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <filesystem>
#include <vector>

namespace groundglass {

// The exact colours of all of a building's surfaces: `truth/surfaces/` holds pages of texels in
// linear light (page_0.png, 16 bit, encoded to sRGB as all pictures), for each page the kind of
// each texel (kinds_0.png), and charts.csv, which says where each face lies.

// What a texel shows. A face's colour is what comes first square on to it, from a little before its
// plane.
enum class TexelKind : uint16_t {
  kNone = 0,    // off the face
  kExact = 1,   // matt, all of it in the model's plane with nothing before it: texture is judged
  kGlass = 2,   // its own colour, without what it mirrors
  kRelief = 3,  // part of the building that the model leaves out, before or behind the plane
  kEdge = 4,    // partly on the face, or behind another part of the building
};

// Where one face lies: texels of `texel` feet's width on a metric grid, level and upright on walls,
// towards the east and the north on floors and roofs.
struct SurfaceChart {
  int face = -1;  // of the model, from 0
  int page = -1;
  int left = 0;  // on the page, px
  int top = 0;
  int width = 0;
  int height = 0;
  // The chart's top left corner, and the steps to the next column and row.
  Eigen::Vector3d corner_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d step_right_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d step_down_in_world = Eigen::Vector3d::Zero();

  // A place of the chart; (0.5, 0.5) is the middle of its first texel.
  Eigen::Vector3d PointInWorld(double column, double row) const {
    return corner_in_world + column * step_right_in_world + row * step_down_in_world;
  }
};

struct SurfacePage {
  ImageF radiance;  // linear
  Image16 kinds;    // TexelKind
};

struct SurfaceTruthOptions {
  double texel = 0.125;      // width, in the model's unit
  int page_width_px = 4096;  // wider if a face needs it
  int page_height_px = 2048;

  void Check() const;  // throws Error naming the first field out of range
};

// A chart for each face, packed on as few pages as shelves allow.
std::vector<SurfaceChart> LayOutSurfaces(const PolygonModel& model,
                                         const SurfaceTruthOptions& options);

// The colours of the charts of one page, as `light` shows them: each texel is the mean over its
// area. The same whatever the number of threads.
SurfacePage RenderSurfacePage(const SyntheticWorld& world,
                              const PolygonModel& model,
                              const Visibility& visibility,
                              const SkyMap& sky_map,
                              const Daylight& light,
                              const std::vector<SurfaceChart>& charts,
                              int page);

// Writes truth/surfaces page by page; throws Error.
void WriteSurfaces(const std::filesystem::path& folder,
                   const SyntheticWorld& world,
                   const PolygonModel& model,
                   const Visibility& visibility,
                   const SkyMap& sky_map,
                   const Daylight& light,
                   const SurfaceTruthOptions& options);

// charts.csv: faces from 1, positions in `site`. Reading throws Error naming file and line.
std::string FormatCharts(const std::vector<SurfaceChart>& charts);
std::vector<SurfaceChart> ReadCharts(const std::filesystem::path& surfaces_folder);
void WriteSurfacePage(const std::filesystem::path& surfaces_folder,
                      int page,
                      const SurfacePage& surfaces);
SurfacePage ReadSurfacePage(const std::filesystem::path& surfaces_folder, int page);

}  // namespace groundglass
