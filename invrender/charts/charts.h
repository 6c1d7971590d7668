// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/chart_options.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// A flat piece of the model laid out to scale: one face, or several that lie in one plane and
// touch. Chart coordinates are texels, x right and y down as seen from the front, the chart's
// bounding box starting at (0, 0); walls stand upright. The map to the plane is a similarity, so
// nothing shears.
struct Chart {
  std::vector<int> faces;
  Eigen::Vector3d origin_in_world = Eigen::Vector3d::Zero();  // of the chart's (0, 0)
  Eigen::Vector3d right_in_world = Eigen::Vector3d::UnitX();
  Eigen::Vector3d down_in_world = Eigen::Vector3d::UnitY();
  Eigen::Vector3d normal_in_world = Eigen::Vector3d::UnitZ();
  double width = 0;  // model's unit
  double height = 0;
  double texel_size = 0;  // model's unit; 0: no photograph shows the chart
  int width_texels = 0;
  int height_texels = 0;
  int page = -1;
  int x_on_page = 0;  // of the chart's first texel
  int y_on_page = 0;

  void SetTexelSize(double size);
  Eigen::Vector3d PointInWorld(const Eigen::Vector2d& texel) const {
    return origin_in_world + texel_size * (texel.x() * right_in_world + texel.y() * down_in_world);
  }
  Eigen::Vector2d PlanePoint(const Eigen::Vector3d& point_in_world) const {
    const Eigen::Vector3d offset = point_in_world - origin_in_world;
    return {offset.dot(right_in_world), offset.dot(down_in_world)};
  }
  Eigen::Vector2d TexelFromWorld(const Eigen::Vector3d& point_in_world) const {
    return PlanePoint(point_in_world) / texel_size;
  }
};

// Charts for all faces of the model, in order of their first faces; texel sizes are not yet set.
std::vector<Chart> MakeCharts(const PolygonModel& model, const ChartOptions& options = {});

// chart_of_face[face] is the chart's index.
std::vector<int> ChartOfFace(const std::vector<Chart>& charts, size_t num_faces);

// What each texel of a chart stands for. A texel that only the face's border crosses stands for
// the nearest point of the face, so that nothing is looked up outside of it.
class ChartTexels {
 public:
  ChartTexels(const PolygonModel& model, const Chart& chart);

  int width() const { return faces_.width; }
  int height() const { return faces_.height; }
  // The face in the model, or -1 where the chart has none.
  int FaceAt(int x, int y) const { return *faces_.At(x, y); }
  // True if the texel's centre lies in the face.
  bool IsCentreInside(int x, int y) const { return *inside_.At(x, y) != 0; }
  // The texel's own point, in chart coordinates.
  Eigen::Vector2d PointAt(int x, int y) const;

 private:
  struct Outline {
    struct Side {
      Eigen::Vector2d start;
      Eigen::Vector2d end;
    };
    int face = -1;
    std::vector<Side> sides;  // around the face and its holes; chart coordinates, texels
  };
  // Texels whose centre lies inside: even-odd spans of each row.
  void FillInside(const Outline& outline);
  // Texels without a face yet that only a border crosses.
  void FillAlong(const Outline::Side& side, int face);

  std::vector<Outline> outlines_;
  Raster<int32_t> faces_;
  Raster<uint8_t> inside_;
};

}  // namespace groundglass
