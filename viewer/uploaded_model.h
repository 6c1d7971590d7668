// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/textured_model.h"
#include "viewer/gl_functions.h"
#include "viewer/render_mesh.h"

#include <string>
#include <vector>

namespace groundglass {

// A textured model in OpenGL.
struct UploadedModel {
  RenderMesh mesh;
  GlVertexArray vertex_array;
  GlBuffer vertex_buffer;
  std::vector<GlTexture> pages;
};

// Pages larger than max_page_px either way are halved until they fit, with a line in `warnings`.
// Errors of MakeRenderMesh and UploadTexturePage.
UploadedModel UploadModel(const GlFunctions& gl,
                          const TexturedModel& model,
                          int max_page_px,
                          std::vector<std::string>& warnings);

}  // namespace groundglass
