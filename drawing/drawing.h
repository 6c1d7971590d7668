// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/orthographic_view.h"
#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// The plane of a drawing: where u = v = 0, u to the right and v up as the viewer sees it. Unit
// lengths, square to each other. Of an upright plane v is the height in the model.
struct DrawingPlane {
  Eigen::Vector3d origin_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_in_world = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up_in_world = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d TowardsViewer() const { return right_in_world.cross(up_in_world); }
};

// A strip of a drawing that shows what lies between two u of one plane.
struct DrawingPanel {
  DrawingPlane plane;
  double u_start = 0;
  double u_end = 0;
  double u_on_sheet = 0;     // where u_start comes on the sheet
  double near_depth = -1e9;  // behind the plane; what lies nearer or farther is left out
  double far_depth = 1e9;
};

// What is drawn to scale, on a sheet with u to the right and v up, in the model's unit. Of a single
// panel these are its plane's own.
struct Drawing {
  std::string name;                  // "east wall", "south", "section"
  std::vector<DrawingPanel> panels;  // from left to right, without gaps
  double v_start = 0;
  double v_end = 0;
  bool is_section = false;  // the faces that the plane cuts have lines of their own

  double UStart() const { return panels.front().u_on_sheet; }
  double UEnd() const {
    return panels.back().u_on_sheet + panels.back().u_end - panels.back().u_start;
  }
};

// Lengths in the model's unit.
struct DrawingOptions {
  double margin = 0;        // around what is drawn
  bool is_cropped = false;  // the named faces only, and what lies before and behind them
  // How far before and behind its plane things are drawn; all of the model without it. A developed
  // facade shows no more than 1 m before its planes, if nothing else is said.
  std::optional<double> before;
  std::optional<double> behind;
  // Walls closer together in direction than this are in one elevation, of `all`.
  double same_side_deg = 20;
  // A side with less wall than this share of the largest side's is none, of `all`.
  double least_side = 0.1;

  void Check() const;  // throws Error naming the first field out of range
};

// Square to these faces (from 0), in the plane of the largest: upright for walls, even for those
// that lean a little, and on the slope for roofs; floors with north up. Shows the whole model from
// there, unless cropped. Error if the faces look to opposite sides.
Drawing MakeElevation(const PolygonModel& model,
                      const std::vector<int>& faces,
                      const std::string& name,
                      const DrawingOptions& options = {});

// One elevation for each side that the model's walls face, named after the direction that the side
// faces ("north", "southwest"), clockwise from north. Error if the model has no wall.
std::vector<Drawing> MakeAllElevations(const PolygonModel& model,
                                       const DrawingOptions& options = {});

// What is left behind an upright plane through two points, which come to the left and to the right.
Drawing MakeSection(const PolygonModel& model,
                    const Eigen::Vector2d& left_in_world,
                    const Eigen::Vector2d& right_in_world,
                    const DrawingOptions& options = {});
// What is left below a level plane: a plan, with north up.
Drawing MakePlan(const PolygonModel& model, double height, const DrawingOptions& options = {});

// Whether the plane of a section or a plan meets the model: else it shows what an elevation would.
bool CutsModel(const PolygonModel& model, const Drawing& drawing);

// The fronts of a street laid out flat, side by side from left to right as one walks past them:
// each of these faces in its own plane; neighbours in one plane share a panel.
Drawing MakeDevelopedFacade(const PolygonModel& model,
                            const std::vector<int>& faces,
                            const std::string& name,
                            const DrawingOptions& options = {});

// The direction in which a plane faces, clockwise from north, and its word: "north", "southwest".
double FacingDeg(const DrawingPlane& plane);
std::string CompassWord(double bearing_deg);

// A drawing's pixels; the first one's outer corner is at UStart, v_end.
struct DrawingGrid {
  int width_px = 0;
  int height_px = 0;
  double pixel_size = 1;  // model's unit
};
// Error if there would be more than 2^31 pixels either way, or none.
DrawingGrid MakeGrid(const Drawing& drawing, double pixel_size);

// A panel's part of the grid: its columns, and the view that draws them, all rows.
struct PanelView {
  int panel = 0;
  int first_column = 0;
  OrthographicView view;
};
std::vector<PanelView> MakePanelViews(const Drawing& drawing, const DrawingGrid& grid);

}  // namespace groundglass
