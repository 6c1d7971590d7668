// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/orthographic_view.h"
#include "viewer/gl_functions.h"
#include "viewer/renderer.h"
#include "viewer/uploaded_model.h"

#include <Eigen/Dense>

#include <array>

namespace groundglass {

// From a mesh's own places to clip coordinates: as a camera without distortion sees them, and by
// parallel rays.
Eigen::Matrix4f ClipFromLocal(const RenderMesh& mesh, const Camera& pinhole);
Eigen::Matrix4f ClipFromLocal(const RenderMesh& mesh, const OrthographicView& view);

// The programs that draw a model's faces into the target that is bound.
class FaceDrawing {
 public:
  // gl must outlive the object.
  explicit FaceDrawing(const GlFunctions& gl);

  // In colour, as options.mode says.
  void DrawFaces(const UploadedModel& model,
                 const Eigen::Matrix4f& clip_from_local,
                 const RenderOptions& options) const;
  // As numbers from 1.
  void DrawLabels(const UploadedModel& model, const Eigen::Matrix4f& clip_from_local) const;

 private:
  const GlFunctions& gl_;
  std::array<GlProgram, 6> face_programs_;  // by Colouring
  GlProgram label_program_;
};

}  // namespace groundglass
