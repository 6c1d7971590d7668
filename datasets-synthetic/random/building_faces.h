// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/random/massing.h"

namespace groundglass {

// How much of a massing becomes polygons.
struct BuildingDetail {
  bool has_openings = true;
  double recess = 0;  // of openings behind the wall
  bool has_mullions = false;
  bool has_ledges = true;  // cornices, courses, plinths
  bool has_sills = true;
  bool has_parapets = true;   // that stand up above the roof; else roofs lie at their top
  bool has_overhangs = true;  // else roofs end at the walls
  bool has_chimneys = true;
  bool has_dormers = true;
  bool has_steps = true;
  bool has_porch = true;
  bool has_neighbours = true;
  bool neighbours_have_openings = true;
  bool has_round_corners = true;  // else in three flat faces a quarter
};

// A polygon of a building, in the plan's frame, counterclockwise seen from its front.
struct BuildingFace {
  std::vector<Eigen::Vector3d> corners;
  std::string name;
  Material material = Material::kPlain;
  Rgb color = Rgb(0.5f, 0.5f, 0.5f);
  // Texture: where along its wall it begins, how often 5 units go into it (panes of a window); 0:
  // as its size is.
  double start_u = 0;
  double panes = 0;
  bool is_fine = false;  // a part that a model without recesses leaves out
  bool is_neighbour = false;
};

// Neighbours come last.
std::vector<BuildingFace> MakeBuildingFaces(const Massing& massing, const BuildingDetail& detail);

// Used by MakeBuildingFaces.
class FaceList {
 public:
  void Add(std::vector<Eigen::Vector3d> corners,
           const std::string& name,
           Material material,
           const Rgb& color,
           bool is_fine = false);
  // The five upper sides of a box, and its underside if asked for.
  void AddBox(const Eigen::Vector3d& low,
              const Eigen::Vector3d& high,
              const std::string& name,
              Material material,
              const Rgb& color,
              bool is_fine,
              bool has_underside);
  BuildingFace& Last() { return faces_.back(); }
  std::vector<BuildingFace>& Faces() { return faces_; }

 private:
  std::vector<BuildingFace> faces_;
};

// An upright wall piece of a body, walked with the outside on the right.
struct WallPiece {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double low = 0;
  double high_from = 0;  // its top at either end
  double high_to = 0;
  double apex = 0;          // of a gable, above the middle; 0: none
  double start_s = 0;       // of `from` on its side of the plan
  int side = -1;            // of the plan; -1: of a rounded corner
  bool bends_from = false;  // convex corners of the body, at which ledges meet
  bool bends_to = false;
};
// All walls of a plan's ring.
std::vector<WallPiece> WallPiecesOf(const Body& body, bool of_court, bool is_round);

// The outline of a flat roof or parapet, `inset` from the walls.
std::vector<Eigen::Vector2d> RingOf(const Body& body, bool of_court, double inset, bool is_round);

// A wall with its openings, ledges and sills.
void AddWallPiece(const Body& body,
                  const WallPiece& wall,
                  const std::vector<Opening>& openings,
                  const BuildingDetail& detail,
                  const std::string& name,
                  FaceList& faces);

// `main`: the body into whose roof this one's runs; unused else.
void AddRoof(const Body& body, const Body& main, const BuildingDetail& detail, FaceList& faces);

void AddDormer(const Body& main,
               const Dormer& dormer,
               const std::string& name,
               const BuildingDetail& detail,
               FaceList& faces);

}  // namespace groundglass
