// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/render_mesh.h"

#include "scene/error.h"
#include "scene/face_outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace groundglass {
namespace {

void CheckTexture(const TexturedModel& textured, int face) {
  const FaceTexture& texture = textured.faces[face];
  if (texture.page < 0) return;
  if (texture.page >= static_cast<int>(textured.pages.size())) {
    throw Error("viewer: " + DescribeFace(textured.model, face) + " is on texture page " +
                std::to_string(texture.page) + ", but there are " +
                std::to_string(textured.pages.size()));
  }
  if (texture.corners_texel.size() != textured.model.faces[face].points.size()) {
    throw Error("viewer: " + DescribeFace(textured.model, face) + " has " +
                std::to_string(textured.model.faces[face].points.size()) + " corners but " +
                std::to_string(texture.corners_texel.size()) + " texel coordinates");
  }
}

// The nearest point to the origin of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double DistanceToTriangle(const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double d1 = -ab.dot(a);
  const double d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0) return a.norm();
  const double d3 = -ab.dot(b);
  const double d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3) return b.norm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (a + d1 / (d1 - d3) * ab).norm();
  const double d5 = -ab.dot(c);
  const double d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6) return c.norm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (a + d2 / (d2 - d6) * ac).norm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).norm();
  }
  const double denominator = va + vb + vc;
  return (a + vb / denominator * ab + vc / denominator * ac).norm();
}

}  // namespace

bool RenderMesh::IsRepeated(int page) const {
  constexpr float kBeyond = 0.001f;  // rounding is not meant
  for (const RenderBatch& batch : batches) {
    if (batch.page != page) continue;
    for (int i = 0; i < batch.num_vertices; ++i) {
      const Eigen::Vector2f& on_page = vertices[batch.first_vertex + i].on_page;
      if (on_page.minCoeff() < -kBeyond || on_page.maxCoeff() > 1 + kBeyond) return true;
    }
  }
  return false;
}

RenderMesh MakeRenderMesh(const TexturedModel& textured) {
  const PolygonModel& model = textured.model;
  if (!textured.faces.empty() && textured.faces.size() != model.faces.size()) {
    throw Error("viewer: the model has " + std::to_string(model.faces.size()) +
                " faces but textures for " + std::to_string(textured.faces.size()));
  }
  RenderMesh mesh;
  mesh.origin_in_world = ComputeBounds(model).Center();
  std::map<int, std::vector<int>> faces_of_page;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    int page = -1;
    if (!textured.faces.empty()) {
      CheckTexture(textured, face);
      page = textured.faces[face].page;
    }
    faces_of_page[page].push_back(face);
  }
  for (const auto& [page, faces] : faces_of_page) {
    RenderBatch batch;
    batch.page = page;
    batch.first_vertex = static_cast<int>(mesh.vertices.size());
    for (const int face : faces) {
      const Eigen::Vector3f normal = ComputeFacePlane(model, face).normal_in_world.cast<float>();
      const std::vector<int>& points = model.faces[face].points;
      for (const std::array<int, 3>& triangle : TriangulateCorners(model, face)) {
        for (const int corner : triangle) {
          const int point = points[corner];
          RenderVertex vertex;
          vertex.position = (model.points_in_world[point] - mesh.origin_in_world).cast<float>();
          vertex.normal = normal;
          vertex.on_page = Eigen::Vector2f::Zero();
          if (page >= 0) {
            const Image8& picture = textured.pages[page].srgb8;
            vertex.on_page = textured.faces[face]
                                 .corners_texel[corner]
                                 .cwiseQuotient(Eigen::Vector2d(picture.width, picture.height))
                                 .cast<float>();
          }
          vertex.face = static_cast<uint32_t>(face);
          mesh.vertices.push_back(vertex);
        }
      }
    }
    batch.num_vertices = static_cast<int>(mesh.vertices.size()) - batch.first_vertex;
    mesh.batches.push_back(batch);
  }
  return mesh;
}

DepthRange FindDepthRange(const RenderMesh& mesh, const Camera& pinhole) {
  const Eigen::Vector3d eye = pinhole.PositionInWorld() - mesh.origin_in_world;
  const Eigen::Vector3d forward = pinhole.ForwardInWorld();
  double nearest = 1e300;
  double farthest_depth = 0;
  for (size_t i = 0; i + 2 < mesh.vertices.size(); i += 3) {
    const Eigen::Vector3d a = mesh.vertices[i].position.cast<double>() - eye;
    const Eigen::Vector3d b = mesh.vertices[i + 1].position.cast<double>() - eye;
    const Eigen::Vector3d c = mesh.vertices[i + 2].position.cast<double>() - eye;
    const double depth = std::max({forward.dot(a), forward.dot(b), forward.dot(c)});
    if (depth <= 0) continue;
    nearest = std::min(nearest, DistanceToTriangle(a, b, c));
    farthest_depth = std::max(farthest_depth, depth);
  }
  if (farthest_depth <= 0) return {1, 2};
  // In the frame's corners a point at a given distance is least deep.
  double cosine = 1;
  for (const double x : {0.0, 1.0 * pinhole.width_px}) {
    for (const double y : {0.0, 1.0 * pinhole.height_px}) {
      cosine = std::min(cosine, 1 / UnprojectToCam(pinhole, {x, y}).norm());
    }
  }
  DepthRange range;
  range.far_depth = 1.01 * farthest_depth;
  range.near_depth = std::max(0.99 * nearest * cosine, 1e-5 * range.far_depth);
  return range;
}

}  // namespace groundglass
