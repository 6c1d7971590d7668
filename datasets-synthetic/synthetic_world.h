// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/material.h"
#include "scene/polygon_model.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace groundglass {

// Everything that a photograph may show: the building's faces first, which are also the model that
// people get; then the ground and what stands around.
struct SyntheticWorld {
  PolygonModel geometry;
  std::vector<Surface> surfaces;  // one for each of the geometry's faces
  int num_model_faces = 0;        // the first ones
  // The first faces are the building, and the model is another drawing of it.
  bool is_model_apart = false;

  // A rounded corner, which the model has as three flat faces between tangent points, given
  // counterclockwise seen from above.
  struct RoundCorner {
    std::array<int, 3> faces = {-1, -1, -1};
    Eigen::Vector2d center_in_world = Eigen::Vector2d::Zero();
  };
  std::vector<RoundCorner> round_corners;

  // What stands on the ground keeps the sky from it: about a rectangle by `strength` (share of the
  // sky), fading out over `reach`. Feet.
  struct ContactShadow {
    Eigen::Vector2d center = Eigen::Vector2d::Zero();
    Eigen::Vector2d along = Eigen::Vector2d::UnitX();
    double half_length = 0;
    double half_width = 0;
    double reach = 1;
    double strength = 0;
  };
  std::vector<ContactShadow> contact_shadows;
  // The share of the sky that they leave to a place on the ground.
  double SkyLeftAt(const Eigen::Vector2d& ground_in_world) const;

  // The model that people get: the first faces and the points that they use. Ask for it before
  // relief moves the geometry away from it.
  PolygonModel Model() const;
};

// Adds polygons to a world, each with a texture frame that fits it.
class WorldBuilder {
 public:
  // Faces added by this builder share their points with one another.
  WorldBuilder(SyntheticWorld& world, uint64_t seed) : world_(world), seed_(seed) {}

  // Adds a polygon given in `world`, counterclockwise seen from its front; returns its face. On
  // walls v is the height and u runs to the right, both from the world's own zero where the wall
  // follows an axis, so that grids run through from face to face; floors and roofs take u = east,
  // v = north.
  int AddPolygon(const std::vector<Eigen::Vector3d>& corners_in_world,
                 Material material,
                 const Rgb& color,
                 const std::string& name,
                 int mask_code = 0);

  // A wall's piece between two heights.
  struct Band {
    double low = 0;
    double high = 0;
    Material material = Material::kTile;
    Rgb color = Rgb(0.7f, 0.7f, 0.7f);
    std::string name;
  };
  // The vertical wall over a line on the ground that is walked with the outside on the right.
  void AddWall(const Eigen::Vector2d& from_in_world,
               const Eigen::Vector2d& to_in_world,
               const std::vector<Band>& bands,
               const std::string& name);

  // An upright box without its bottom; `mask_code` as in Surface.
  void AddBox(const Eigen::Vector3d& low_in_world,
              const Eigen::Vector3d& high_in_world,
              Material side,
              Material top,
              const Rgb& color,
              const std::string& name,
              int mask_code = 0);

  // An upright prism of n sides about a line from `base` to `top`, tapering; its ends are open.
  void AddTaperedColumn(const Eigen::Vector3d& base_in_world,
                        const Eigen::Vector3d& top_in_world,
                        double base_radius,
                        double top_radius,
                        int num_sides,
                        Material material,
                        const Rgb& color,
                        const std::string& name,
                        int mask_code);

  void AddContactShadow(const SyntheticWorld::ContactShadow& shadow) {
    world_.contact_shadows.push_back(shadow);
  }

  // Lets the texture and the weathering of a wall's pieces, in one plane, run through them all.
  void JoinWall(const std::vector<int>& faces);

  // Shifts a face's texture along u, so that a wall's grid meets its neighbour's.
  void ShiftTexture(int face, double shift_u);

  Surface& SurfaceOf(int face) { return world_.surfaces[face]; }
  // The face of this name. Throws Error if there is none.
  int FaceNamed(const std::string& name) const;

 private:
  int PointIndex(const Eigen::Vector3d& point_in_world);

  SyntheticWorld& world_;
  uint64_t seed_ = 0;
  std::map<std::array<int64_t, 3>, int> point_of_place_;  // by position to a tenth of a thousandth
};

}  // namespace groundglass
