// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// A wall that leans less than this is drawn plumb, a floor that slopes less level.
constexpr double kPlumbDeg = 15;

struct Range {
  double min = 1e300;
  double max = -1e300;
  void Add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

struct Extent {
  Range u;
  Range v;
  void Add(const DrawingPlane& plane, const Eigen::Vector3d& point_in_world) {
    const Eigen::Vector3d offset = point_in_world - plane.origin_in_world;
    u.Add(offset.dot(plane.right_in_world));
    v.Add(offset.dot(plane.up_in_world));
  }
};

Extent ExtentOfFaces(const PolygonModel& model,
                     const std::vector<int>& faces,
                     const DrawingPlane& plane) {
  Extent extent;
  for (const int face : faces) {
    for (const int point : model.faces[face].points) {
      extent.Add(plane, model.points_in_world[point]);
    }
  }
  return extent;
}

double DepthBehind(const DrawingPlane& plane, const Eigen::Vector3d& point_in_world) {
  return -(point_in_world - plane.origin_in_world).dot(plane.TowardsViewer());
}

Extent ExtentOfModel(const PolygonModel& model, const DrawingPanel& panel) {
  Extent extent;
  for (const Face& face : model.faces) {
    for (const int point : face.points) {
      const Eigen::Vector3d& point_in_world = model.points_in_world[point];
      const double depth = DepthBehind(panel.plane, point_in_world);
      if (depth >= panel.near_depth && depth <= panel.far_depth) {
        extent.Add(panel.plane, point_in_world);
      }
    }
  }
  return extent;
}

int LargestFace(const PolygonModel& model, const std::vector<int>& faces) {
  return *std::max_element(faces.begin(), faces.end(), [&](int a, int b) {
    return ComputeFaceArea(model, a) < ComputeFaceArea(model, b);
  });
}

// The plane through a point, seen from where `normal` points.
DrawingPlane PlaneThrough(const Eigen::Vector3d& point_in_world, Eigen::Vector3d normal) {
  normal.normalize();
  const double steepness_deg = DegreesFromRadians(std::asin(std::clamp(normal.z(), -1.0, 1.0)));
  DrawingPlane plane;
  if (std::abs(steepness_deg) > 90 - kPlumbDeg) {
    normal = {0, 0, normal.z() > 0 ? 1.0 : -1.0};
    plane.up_in_world = Eigen::Vector3d::UnitY();
  } else {
    if (std::abs(steepness_deg) < kPlumbDeg) normal = Eigen::Vector3d(normal.x(), normal.y(), 0);
    normal.normalize();
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(normal).normalized();
    plane.up_in_world = normal.cross(right);
  }
  plane.right_in_world = plane.up_in_world.cross(normal);
  plane.origin_in_world = normal.dot(point_in_world) * normal;
  return plane;
}

DrawingPlane PlaneOfFaces(const PolygonModel& model,
                          const std::vector<int>& faces,
                          const std::string& name) {
  if (faces.empty()) throw Error("elevation " + name + ": no face is named");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (const int face : faces) {
    sum += DoubledVectorArea(model, face) / 2;
    area += ComputeFaceArea(model, face);
  }
  if (!(sum.norm() > 0.5 * area)) {
    throw Error("elevation " + name + ": its faces look to different sides; name those of one");
  }
  const int largest = LargestFace(model, faces);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int point : model.faces[largest].points) middle += model.points_in_world[point];
  return PlaneThrough(middle / model.faces[largest].points.size(), sum);
}

DrawingPanel PanelIn(const DrawingPlane& plane, const DrawingOptions& options) {
  DrawingPanel panel;
  panel.plane = plane;
  if (options.before) panel.near_depth = -*options.before;
  if (options.behind) panel.far_depth = *options.behind;
  return panel;
}

// Moves u = 0 to the left end of what is drawn.
void StartAt(double u, DrawingPlane& plane) { plane.origin_in_world += u * plane.right_in_world; }

// A drawing of one panel, framed by an extent in its plane.
Drawing FrameIn(const std::string& name,
                DrawingPanel panel,
                const Extent& extent,
                const DrawingOptions& options) {
  if (!(extent.u.max > extent.u.min) || !(extent.v.max > extent.v.min)) {
    throw Error("drawing " + name + ": nothing of the model is there");
  }
  StartAt(extent.u.min, panel.plane);
  panel.u_start = panel.u_on_sheet = -options.margin;
  panel.u_end = extent.u.max - extent.u.min + options.margin;
  Drawing drawing;
  drawing.name = name;
  drawing.panels = {panel};
  drawing.v_start = extent.v.min - options.margin;
  drawing.v_end = extent.v.max + options.margin;
  return drawing;
}

// Walls that face about the same way.
struct Side {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of their areas
  std::vector<int> faces;
};

std::vector<Side> FindSides(const PolygonModel& model, const DrawingOptions& options) {
  std::vector<int> walls;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
    if (std::abs(normal.z()) < std::sin(RadiansFromDegrees(kPlumbDeg))) walls.push_back(face);
  }
  std::stable_sort(walls.begin(), walls.end(), [&](int a, int b) {
    return ComputeFaceArea(model, a) > ComputeFaceArea(model, b);
  });
  const double cosine = std::cos(RadiansFromDegrees(options.same_side_deg));
  std::vector<Side> sides;
  for (const int wall : walls) {
    Eigen::Vector3d area = DoubledVectorArea(model, wall) / 2;
    area.z() = 0;
    auto side = std::find_if(sides.begin(), sides.end(), [&](const Side& known) {
      return known.sum.normalized().dot(area.normalized()) > cosine;
    });
    if (side == sides.end()) side = sides.insert(sides.end(), Side());
    side->sum += area;
    side->faces.push_back(wall);
  }
  double largest = 0;
  for (const Side& side : sides) largest = std::max(largest, side.sum.norm());
  std::erase_if(sides,
                [&](const Side& side) { return side.sum.norm() < options.least_side * largest; });
  return sides;
}

bool AreInOnePlane(const DrawingPlane& a, const DrawingPlane& b, double tolerance) {
  const Eigen::Vector3d offset = b.origin_in_world - a.origin_in_world;
  return a.TowardsViewer().dot(b.TowardsViewer()) > std::cos(RadiansFromDegrees(1)) &&
         std::abs(offset.dot(a.TowardsViewer())) < tolerance;
}

}  // namespace

void DrawingOptions::Check() const {
  CheckAtLeast(margin, 0, "drawing options: margin");
  if (before) CheckFinite(*before, "drawing options: before");
  if (behind) CheckFinite(*behind, "drawing options: behind");
  if (before && behind) CheckAbove(*before + *behind, 0, "drawing options: before and behind");
  CheckFromTo(same_side_deg, 0, 45, "drawing options: same_side_deg");
  CheckFromTo(least_side, 0, 1, "drawing options: least_side");
}

Drawing MakeElevation(const PolygonModel& model,
                      const std::vector<int>& faces,
                      const std::string& name,
                      const DrawingOptions& options) {
  options.Check();
  const DrawingPanel panel = PanelIn(PlaneOfFaces(model, faces, name), options);
  const Extent extent =
      options.is_cropped ? ExtentOfFaces(model, faces, panel.plane) : ExtentOfModel(model, panel);
  return FrameIn(name, panel, extent, options);
}

std::vector<Drawing> MakeAllElevations(const PolygonModel& model, const DrawingOptions& options) {
  options.Check();
  std::vector<Drawing> drawings;
  for (const Side& side : FindSides(model, options)) {
    drawings.push_back(MakeElevation(model, side.faces, "", options));
  }
  if (drawings.empty()) throw Error("the model has no wall, and so no elevation; name a face");
  std::stable_sort(drawings.begin(), drawings.end(), [](const Drawing& a, const Drawing& b) {
    return FacingDeg(a.panels[0].plane) < FacingDeg(b.panels[0].plane);
  });
  // Half a wind before north is north still.
  const auto first = std::find_if(drawings.begin(), drawings.end(), [](const Drawing& drawing) {
    return FacingDeg(drawing.panels[0].plane) >= 337.5;
  });
  std::rotate(drawings.begin(), first, drawings.end());
  std::vector<std::string> words;
  for (const Drawing& drawing : drawings) {
    words.push_back(CompassWord(FacingDeg(drawing.panels[0].plane)));
  }
  for (size_t i = 0; i < drawings.size(); ++i) {
    drawings[i].name = words[i];
    if (std::count(words.begin(), words.end(), words[i]) > 1) {
      const long bearing_deg = std::lround(FacingDeg(drawings[i].panels[0].plane));
      drawings[i].name += " " + std::to_string(bearing_deg);
    }
  }
  return drawings;
}

Drawing MakeSection(const PolygonModel& model,
                    const Eigen::Vector2d& left_in_world,
                    const Eigen::Vector2d& right_in_world,
                    const DrawingOptions& options) {
  options.Check();
  const Eigen::Vector2d along = right_in_world - left_in_world;
  if (!(along.norm() > 0)) throw Error("section: its two points are the same");
  const Eigen::Vector3d normal(along.y(), -along.x(), 0);
  DrawingOptions behind = options;
  behind.before = 0;
  const DrawingPanel panel =
      PanelIn(PlaneThrough({left_in_world.x(), left_in_world.y(), 0}, normal), behind);
  Drawing drawing = FrameIn("section", panel, ExtentOfModel(model, panel), behind);
  drawing.is_section = true;
  return drawing;
}

Drawing MakePlan(const PolygonModel& model, double height, const DrawingOptions& options) {
  options.Check();
  DrawingOptions below = options;
  below.before = 0;
  const DrawingPanel panel = PanelIn(PlaneThrough({0, 0, height}, Eigen::Vector3d::UnitZ()), below);
  Drawing drawing = FrameIn("plan", panel, ExtentOfModel(model, panel), below);
  drawing.is_section = true;
  return drawing;
}

bool CutsModel(const PolygonModel& model, const Drawing& drawing) {
  const DrawingPlane& plane = drawing.panels.front().plane;
  return std::any_of(model.faces.begin(), model.faces.end(), [&](const Face& face) {
    Range depth;
    for (const int point : face.points) depth.Add(DepthBehind(plane, model.points_in_world[point]));
    return depth.min < 0 && depth.max > 0;
  });
}

Drawing MakeDevelopedFacade(const PolygonModel& model,
                            const std::vector<int>& faces,
                            const std::string& name,
                            const DrawingOptions& options) {
  options.Check();
  if (faces.empty()) throw Error("developed facade " + name + ": no face is named");
  DrawingOptions within = options;
  if (!within.before) within.before = 1 / MetresPerUnit(model.unit);
  const double tolerance = 1e-3 * ComputeBounds(model).Diagonal();
  std::vector<std::vector<int>> groups;
  for (const int face : faces) {
    const DrawingPlane plane = PlaneOfFaces(model, {face}, name);
    if (!groups.empty() &&
        AreInOnePlane(PlaneOfFaces(model, groups.back(), name), plane, tolerance)) {
      groups.back().push_back(face);
    } else {
      groups.push_back({face});
    }
  }
  Drawing drawing;
  drawing.name = name;
  Range height;
  double on_sheet = 0;
  for (const std::vector<int>& group : groups) {
    DrawingPanel panel = PanelIn(PlaneOfFaces(model, group, name), within);
    const Extent extent = ExtentOfFaces(model, group, panel.plane);
    StartAt(extent.u.min, panel.plane);
    panel.u_end = extent.u.max - extent.u.min;
    panel.u_on_sheet = on_sheet;
    on_sheet += panel.u_end;
    height.Add(extent.v.min);
    height.Add(extent.v.max);
    drawing.panels.push_back(panel);
  }
  drawing.panels.front().u_start -= options.margin;
  drawing.panels.front().u_on_sheet -= options.margin;
  drawing.panels.back().u_end += options.margin;
  drawing.v_start = height.min - options.margin;
  drawing.v_end = height.max + options.margin;
  return drawing;
}

double FacingDeg(const DrawingPlane& plane) {
  const Eigen::Vector3d normal = plane.TowardsViewer();
  const double bearing_deg = DegreesFromRadians(std::atan2(normal.x(), normal.y()));
  return bearing_deg < 0 ? bearing_deg + 360 : bearing_deg;
}

std::string CompassWord(double bearing_deg) {
  constexpr std::array<const char*, 8> kWords = {
      "north", "northeast", "east", "southeast", "south", "southwest", "west", "northwest"};
  return kWords[static_cast<size_t>(std::lround(bearing_deg / 45)) % kWords.size()];
}

DrawingGrid MakeGrid(const Drawing& drawing, double pixel_size) {
  // What is a whole number of pixels but for rounding gets no pixel more.
  const auto count = [&](double length) { return std::ceil(length / pixel_size - 1e-6); };
  const double width = count(drawing.UEnd() - drawing.UStart());
  const double height = count(drawing.v_end - drawing.v_start);
  // More takes days, and no program opens it; a 100 m street at 1:20 and 300 dpi has 1e9.
  constexpr double kMostPixels = 2e10;
  if (!(width >= 1 && height >= 1 && width < 2147483647.0 && height < 2147483647.0 &&
        width * height <= kMostPixels)) {
    throw Error("drawing " + drawing.name + ": it would have " + FormatNumber(width) + " x " +
                FormatNumber(height) + " pixels; choose another scale or resolution");
  }
  return {static_cast<int>(width), static_cast<int>(height), pixel_size};
}

std::vector<PanelView> MakePanelViews(const Drawing& drawing, const DrawingGrid& grid) {
  std::vector<PanelView> views;
  int column = 0;
  for (size_t i = 0; i < drawing.panels.size(); ++i) {
    const DrawingPanel& panel = drawing.panels[i];
    // A column belongs to the panel in which its middle lies.
    const bool is_last = i + 1 == drawing.panels.size();
    const double end_on_sheet = panel.u_on_sheet + panel.u_end - panel.u_start;
    const int end =
        is_last
            ? grid.width_px
            : static_cast<int>(std::lround((end_on_sheet - drawing.UStart()) / grid.pixel_size));
    if (end <= column) continue;
    const double u_on_sheet = drawing.UStart() + column * grid.pixel_size;
    const double u = panel.u_start + u_on_sheet - panel.u_on_sheet;
    PanelView part;
    part.panel = static_cast<int>(i);
    part.first_column = column;
    part.view.width_px = end - column;
    part.view.height_px = grid.height_px;
    part.view.pixel_size = grid.pixel_size;
    part.view.right_in_world = panel.plane.right_in_world;
    part.view.down_in_world = -panel.plane.up_in_world;
    part.view.corner_in_world = panel.plane.origin_in_world + u * panel.plane.right_in_world +
                                drawing.v_end * panel.plane.up_in_world;
    part.view.near_depth = panel.near_depth;
    part.view.far_depth = panel.far_depth;
    views.push_back(part);
    column = end;
  }
  return views;
}

}  // namespace groundglass
