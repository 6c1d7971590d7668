// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/textured_model.h"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

namespace groundglass {

// A textured model as triangles for drawing. Single precision, so positions are relative to
// origin_in_world, the middle of the model.
struct RenderVertex {
  Eigen::Vector3f position;  // world axes, relative to RenderMesh::origin_in_world
  Eigen::Vector3f normal;    // of the whole face, world axes, out of its front
  Eigen::Vector2f on_page;   // 0 to 1 across the page, v down; 0 without a texture
  uint32_t face = 0;         // in the model, from 0
};

// Triangles that share a texture page, one after another.
struct RenderBatch {
  int page = -1;  // -1: plain
  int first_vertex = 0;
  int num_vertices = 0;
};

struct RenderMesh {
  Eigen::Vector3d origin_in_world = Eigen::Vector3d::Zero();
  std::vector<RenderVertex> vertices;
  std::vector<RenderBatch> batches;

  // Whether faces reach beyond the page: other programs lay a picture of bricks side by side.
  bool IsRepeated(int page) const;
};

// Error if a face's texture names no page or has not one texel for each corner.
RenderMesh MakeRenderMesh(const TexturedModel& model);

// Depths that hold all triangles in front of the camera plane and spend no precision in front of
// the nearest: the nearest point of any triangle bounds what can be seen.
struct DepthRange {
  double near_depth = 0;
  double far_depth = 0;
};
DepthRange FindDepthRange(const RenderMesh& mesh, const Camera& pinhole);

}  // namespace groundglass
