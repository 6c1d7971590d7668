// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/face_drawing.h"

#include "viewer/pinhole_frame.h"
#include "viewer/shaders.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace groundglass {
namespace {

// How faces are coloured, and what kFaceFragmentShader calls it.
enum Colouring {
  kTexturedFaces,
  kTexturedAlongSight,
  kPlainFaces,
  kShadedFaces,
  kNumberedFaces,
  kHidingFaces
};
constexpr std::array<const char*, 6> kColourings = {
    "TEXTURED", "TEXTURED_ALONG_SIGHT", "PLAIN", "SHADED", "NUMBERED", "HIDING"};

Colouring ChooseColouring(const RenderOptions& options, const RenderBatch& batch) {
  if (batch.page == kHidingPage) return kHidingFaces;
  if (options.mode == DrawMode::kShaded) return kShadedFaces;
  if (options.mode == DrawMode::kLabels) return kNumberedFaces;
  if (batch.page < 0) return kPlainFaces;
  return options.anisotropy > 1 ? kTexturedAlongSight : kTexturedFaces;
}

Eigen::Vector3f SunDirection(const RenderOptions& options) {
  const double bearing = RadiansFromDegrees(options.sun_bearing_deg);
  const double height = RadiansFromDegrees(options.sun_height_deg);
  return Eigen::Vector3d(std::sin(bearing) * std::cos(height),
                         std::cos(bearing) * std::cos(height),
                         std::sin(height))
      .cast<float>();
}

}  // namespace

Eigen::Matrix4f ClipFromLocal(const RenderMesh& mesh, const Camera& pinhole) {
  const DepthRange range = FindDepthRange(mesh, pinhole);
  Eigen::Matrix4d cam_from_local = Eigen::Matrix4d::Identity();
  cam_from_local.topLeftCorner<3, 3>() = pinhole.cam_from_world.rotation;
  cam_from_local.topRightCorner<3, 1>() = pinhole.cam_from_world * mesh.origin_in_world;
  return (ClipFromCam(pinhole, range.near_depth, range.far_depth) * cam_from_local).cast<float>();
}

Eigen::Matrix4f ClipFromLocal(const RenderMesh& mesh, const OrthographicView& view) {
  double nearest = 1e300;
  double farthest = -1e300;
  for (const RenderVertex& vertex : mesh.vertices) {
    const double depth = view.FromWorld(vertex.position.cast<double>() + mesh.origin_in_world).z();
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  // A little more than the model, unless less is asked for; and never nothing.
  const double slack = 1e-3 * std::max(1e-6, farthest - nearest);
  nearest = std::max(nearest - slack, view.near_depth);
  farthest = std::max(std::min(farthest + slack, view.far_depth), nearest + slack);
  Eigen::Matrix4d clip_from_world = Eigen::Matrix4d::Zero();
  const double per_x = 2 / (view.width_px * view.pixel_size);
  const double per_y = 2 / (view.height_px * view.pixel_size);
  const double per_depth = 2 / (farthest - nearest);
  const Eigen::Vector3d offset = mesh.origin_in_world - view.corner_in_world;
  clip_from_world.row(0) << per_x * view.right_in_world.transpose(),
      per_x * view.right_in_world.dot(offset) - 1;
  clip_from_world.row(1) << per_y * view.down_in_world.transpose(),
      per_y * view.down_in_world.dot(offset) - 1;
  const Eigen::Vector3d forward = view.ForwardInWorld();
  clip_from_world.row(2) << per_depth * forward.transpose(),
      per_depth * (forward.dot(offset) - nearest) - 1;
  clip_from_world(3, 3) = 1;
  return clip_from_world.cast<float>();
}

FaceDrawing::FaceDrawing(const GlFunctions& gl) : gl_(gl) {
  static_assert(kColourings.size() == std::tuple_size_v<decltype(face_programs_)>);
  for (size_t i = 0; i < kColourings.size(); ++i) {
    face_programs_[i] = GlProgram(
        gl,
        kFaceVertexShader,
        std::string("#version 330 core\n#define ") + kColourings[i] + "\n" + kFaceFragmentShader);
  }
  label_program_ = GlProgram(gl, kFaceVertexShader, kLabelFragmentShader);
}

void FaceDrawing::DrawFaces(const UploadedModel& model,
                            const Eigen::Matrix4f& clip_from_local,
                            const RenderOptions& options) const {
  const Eigen::Vector3f sun = SunDirection(options);
  gl_.BindVertexArray(model.vertex_array.Name());
  gl_.Enable(GL_DEPTH_TEST);
  gl_.ActiveTexture(GL_TEXTURE0);
  for (const RenderBatch& batch : model.mesh.batches) {
    const GlProgram& program = face_programs_[ChooseColouring(options, batch)];
    program.Use();
    gl_.UniformMatrix4fv(program.Uniform("clip_from_local"), 1, GL_FALSE, clip_from_local.data());
    gl_.Uniform1i(program.Uniform("page"), 0);
    gl_.Uniform1i(program.Uniform("max_taps"), options.anisotropy);
    gl_.Uniform3f(program.Uniform("sun_direction"), sun.x(), sun.y(), sun.z());
    if (batch.page >= 0) gl_.BindTexture(GL_TEXTURE_2D, model.pages[batch.page].Name());
    gl_.DrawArrays(GL_TRIANGLES, batch.first_vertex, batch.num_vertices);
  }
  gl_.Disable(GL_DEPTH_TEST);
}

void FaceDrawing::DrawLabels(const UploadedModel& model,
                             const Eigen::Matrix4f& clip_from_local) const {
  label_program_.Use();
  gl_.UniformMatrix4fv(
      label_program_.Uniform("clip_from_local"), 1, GL_FALSE, clip_from_local.data());
  gl_.BindVertexArray(model.vertex_array.Name());
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(model.mesh.vertices.size()));
  gl_.Disable(GL_DEPTH_TEST);
}

}  // namespace groundglass
