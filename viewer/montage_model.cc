// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/montage_model.h"

#include "scene/colour_page.h"
#include "viewer/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// Within each triangle of a face: its middle, and places near its corners.
std::vector<Eigen::Vector3d> PlacesOn(const PolygonModel& model, int face) {
  std::vector<Eigen::Vector3d> places;
  for (const std::array<int, 3>& triangle : TriangulateFace(model, face)) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int point : triangle) middle += model.points_in_world[point] / 3;
    places.push_back(middle);
    for (const int point : triangle) {
      places.push_back(0.9 * model.points_in_world[point] + 0.1 * middle);
    }
  }
  return places;
}

bool IsOnBuilding(const Eigen::Vector3d& place_in_world,
                  const Eigen::Vector3d& normal_in_world,
                  const Visibility& building,
                  double tolerance) {
  return building
      .FirstHit(place_in_world + tolerance * normal_in_world, -normal_in_world, 0, 2 * tolerance)
      .has_value();
}

}  // namespace

std::vector<bool> FindRepeatedFaces(const PolygonModel& design,
                                    const Visibility& building,
                                    double tolerance) {
  std::vector<bool> is_repeated(design.faces.size());
  for (int face = 0; face < static_cast<int>(design.faces.size()); ++face) {
    const Eigen::Vector3d normal = ComputeFacePlane(design, face).normal_in_world;
    const std::vector<Eigen::Vector3d> places = PlacesOn(design, face);
    is_repeated[face] =
        !places.empty() &&
        std::all_of(places.begin(), places.end(), [&](const Eigen::Vector3d& place) {
          return IsOnBuilding(place, normal, building, tolerance);
        });
  }
  return is_repeated;
}

TexturedModel DesignToDraw(const TexturedModel& design,
                           const std::vector<int>& faces,
                           const Camera& camera,
                           double plain_albedo) {
  TexturedModel drawn;
  drawn.model.points_in_world = design.model.points_in_world;
  drawn.pages = design.pages;
  const int plain_page = static_cast<int>(drawn.pages.size());
  const auto grey = static_cast<float>(plain_albedo);
  ColourPage plain;
  const Eigen::Vector3d eye = camera.PositionInWorld();
  for (const int face : faces) {
    Face& turned = drawn.model.faces.emplace_back(design.model.faces[face]);
    FaceTexture& texture = drawn.faces.emplace_back();
    if (!design.faces.empty()) texture = design.faces[face];
    if (texture.page < 0) texture = plain.Add({grey, grey, grey}, plain_page, turned.points.size());
    // Programs for sketching draw both sides of a face, so which is its front means nothing.
    const FacePlane plane = ComputeFacePlane(design.model, face);
    if (plane.normal_in_world.dot(eye) < plane.offset) {
      std::reverse(turned.points.begin(), turned.points.end());
      std::reverse(texture.corners_texel.begin(), texture.corners_texel.end());
    }
  }
  if (!plain.IsEmpty()) drawn.pages.push_back(plain.Page());
  return drawn;
}

double BrightestLight(const TexturedModel& design_to_draw, const MontageLight& light) {
  double brightest = 0;
  for (int face = 0; face < static_cast<int>(design_to_draw.model.faces.size()); ++face) {
    const Eigen::Vector3d normal = ComputeFacePlane(design_to_draw.model, face).normal_in_world;
    brightest = std::max(brightest, light.On(normal).maxCoeff());
  }
  return brightest;
}

TexturedModel LightToDraw(const TexturedModel& design_to_draw,
                          const MontageLight& light,
                          double scale) {
  TexturedModel drawn;
  drawn.model = design_to_draw.model;
  const size_t num_faces = drawn.model.faces.size();
  ColourPage lights;
  for (size_t face = 0; face < num_faces; ++face) {
    const Eigen::Vector3d normal =
        ComputeFacePlane(drawn.model, static_cast<int>(face)).normal_in_world;
    const Eigen::Vector3f share = (light.On(normal) / scale).cast<float>();
    drawn.faces.push_back(
        lights.Add({share[0], share[1], share[2]}, 0, drawn.model.faces[face].points.size()));
  }
  drawn.pages.push_back(lights.Page());
  return drawn;
}

TexturedModel HiddenByBuilding(TexturedModel to_draw,
                               const PolygonModel& building,
                               const Camera& camera,
                               double farther) {
  const int first = static_cast<int>(to_draw.model.points_in_world.size());
  const Eigen::Vector3d eye = camera.PositionInWorld();
  for (const Eigen::Vector3d& point : building.points_in_world) {
    to_draw.model.points_in_world.push_back(point + farther * (point - eye).normalized());
  }
  for (Face face : building.faces) {
    for (int& point : face.points) point += first;
    to_draw.model.faces.push_back(std::move(face));
    to_draw.faces.emplace_back().page = kHidingPage;
  }
  return to_draw;
}

}  // namespace groundglass
