// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/length_unit.h"

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One planar polygon: indices into PolygonModel::points_in_world, counterclockwise seen from its
// front. May be concave, and have holes (scene/face_outline.h).
struct Face {
  std::vector<int> points;
  std::string name;  // as commented in the file; may be empty
  int number = 0;    // in its file, from 1; 0 if it has none: its place among the faces counts
};

// Where on Earth the model stands.
struct Georeference {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  double north_deg = 0;  // bearing of the model's north (+Y in world), clockwise from true north
};

// The building as polygons, in `world` and in the model's own unit.
struct PolygonModel {
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<Face> faces;
  LengthUnit unit = LengthUnit::kFoot;
  bool is_unit_assumed = false;  // neither the file nor an option says the unit
  // How far its edges may lie off the building's, one standard deviation, in `unit`; the model's
  // own word or an option's.
  std::optional<double> sigma;
  std::optional<Georeference> georeference;
};

// What people call a face: its number in the model's file, or its place among the faces, from 1
// (scene/face_number.h).
int FaceNumber(const PolygonModel& model, int face);

// Twice the face's vector area (Newell): its direction is the normal, its length twice the area.
Eigen::Vector3d DoubledVectorArea(const PolygonModel& model, int face);

// normal . point = offset, the normal (unit length) pointing out of the face's front.
struct FacePlane {
  Eigen::Vector3d normal_in_world = Eigen::Vector3d::UnitZ();
  double offset = 0;
};

// The face's best plane by Newell's method; exact for planar faces.
FacePlane ComputeFacePlane(const PolygonModel& model, int face);
double ComputeFaceArea(const PolygonModel& model, int face);

// The face cut into triangles of point indices (ear clipping), all with the face's own winding.
std::vector<std::array<int, 3>> TriangulateFace(const PolygonModel& model, int face);

struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  double Diagonal() const { return (max - min).norm(); }
  Eigen::Vector3d Center() const { return (min + max) / 2; }
};
Box ComputeBounds(const PolygonModel& model);

// The same lengths, counted in another unit.
void ChangeUnit(LengthUnit unit, PolygonModel& model);

// "face 12 (east wall)", for messages; `face` counts from 0, people from 1.
std::string DescribeFace(const PolygonModel& model, int face);

}  // namespace groundglass
