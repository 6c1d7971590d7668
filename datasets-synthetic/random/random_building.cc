// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/random_building.h"

#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/random/measured_massing.h"
#include "datasets-synthetic/random/stations.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

int AddFace(const BuildingFace& face, const PlanFrame& frame, WorldBuilder& builder) {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector3d& corner : face.corners) corners.push_back(frame.ToWorld(corner));
  return builder.AddPolygon(corners, face.material, face.color, face.name);
}

// Lets textures start at their wall's corner, and windows have as many panes as they are given.
void FitTexture(const BuildingFace& face, Surface& surface) {
  const double width = surface.high_u - surface.low_u;
  const double scale = face.panes > 0 ? 5 * face.panes / width : 1;
  const double start = face.panes > 0 ? 0 : face.start_u;
  surface.offset_u = (surface.offset_u - surface.low_u) * scale + start;
  surface.axis_u *= scale;
  surface.low_u = start;
  surface.high_u = start + scale * width;
}

// The photographed building. Fine parts are the model's too where it has them (`is_model_fine`).
void AddToWorld(const std::vector<BuildingFace>& faces,
                const PlanFrame& frame,
                const BuildingDetail& model_detail,
                bool neighbours,
                WorldBuilder& builder) {
  for (const BuildingFace& face : faces) {
    if (face.is_neighbour != neighbours) continue;
    const int index = AddFace(face, frame, builder);
    Surface& surface = builder.SurfaceOf(index);
    const bool is_upright = std::abs(surface.axis_v.z()) > 0.999;
    if (is_upright) FitTexture(face, surface);
    surface.is_relief = (face.is_fine && !model_detail.has_ledges) ||
                        (face.panes > 0 && model_detail.recess == 0 && !neighbours);
  }
}

PolygonModel ModelOf(const Massing& massing, const BuildingDetail& detail, const PlanFrame& frame) {
  SyntheticWorld drawing;
  WorldBuilder builder(drawing, 0);
  for (const BuildingFace& face : MakeBuildingFaces(massing, detail)) {
    AddFace(face, frame, builder);
  }
  return drawing.geometry;
}

void PaintGround(const std::string& ground, WorldBuilder& builder) {
  Surface& plaza = builder.SurfaceOf(builder.FaceNamed(kPlazaName));
  if (ground == "grass") {
    plaza.material = Material::kGrass;
    plaza.color = {0.09f, 0.13f, 0.04f};
  } else if (ground == "asphalt") {
    plaza.material = Material::kAsphalt;
    plaza.color = {0.12f, 0.12f, 0.12f};
  }
}

}  // namespace

Subject MakeRandomBuilding(const SynthRecipe& recipe) {
  const RandomTraits& traits = recipe.random;
  Massing massing = DrawMassing(traits, recipe.seed);
  LayOutOpenings(traits, recipe.seed, massing);
  const PlanFrame frame(massing.bodies.front(), traits.heading_deg);
  const BuildingDetail world_detail = DetailOfWorld(traits, recipe.relief);
  const BuildingDetail model_detail = DetailOfModel(traits, recipe.relief);
  const std::vector<BuildingFace> faces = MakeBuildingFaces(massing, world_detail);

  Subject subject;
  Subject::DrawnModel& drawn = subject.drawn_model.emplace();
  const Massing measured = MeasureMassing(massing, traits, recipe.seed, drawn.flaws);
  drawn.model = ModelOf(measured, model_detail, frame);
  drawn.exact_model = ModelOf(massing, model_detail, frame);
  if (traits.model.stated_sigma > 0) drawn.model.sigma = traits.model.stated_sigma;

  WorldBuilder builder(subject.world, SeedFor(recipe.seed, "random building"));
  AddToWorld(faces, frame, model_detail, false, builder);
  const int num_own_faces = static_cast<int>(subject.world.geometry.faces.size());
  AddToWorld(faces, frame, model_detail, true, builder);
  const int num_built_faces = static_cast<int>(subject.world.geometry.faces.size());
  subject.world.num_model_faces = model_detail.has_neighbours ? num_built_faces : num_own_faces;
  subject.world.is_model_apart = true;
  const Box built = ComputeBounds(subject.world.geometry);
  subject.built = built;
  const double reach = (built.max - built.min).head<2>().maxCoeff() / 2;
  AddSurroundings(builder, built.Center().head<2>(), reach + 70, recipe.seed);
  PaintGround(traits.ground, builder);

  const StationSite site{subject.world,
                         num_own_faces,
                         massing,
                         frame,
                         traits,
                         static_cast<double>(recipe.width_px) / recipe.height_px,
                         recipe.seed};
  subject.views = DrawStations(site, recipe.num_views > 0 ? recipe.num_views : 8, "s");
  subject.novel_views = DrawStations(site, 1, "n");
  return subject;
}

}  // namespace groundglass
