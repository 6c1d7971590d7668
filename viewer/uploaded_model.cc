// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/uploaded_model.h"

#include "viewer/texture_page.h"

#include <cstddef>

namespace groundglass {
namespace {

// Places of the vertices' numbers as kFaceVertexShader has them.
enum VertexLocation : GLuint { kAtPosition, kAtNormal, kAtOnPage, kAtFace };

void DescribeFloats(const GlFunctions& gl, VertexLocation location, int size, size_t offset) {
  gl.EnableVertexAttribArray(location);
  gl.VertexAttribPointer(location,
                         size,
                         GL_FLOAT,
                         GL_FALSE,
                         sizeof(RenderVertex),
                         reinterpret_cast<const void*>(offset));
}

void UploadVertices(const GlFunctions& gl, UploadedModel& model) {
  model.vertex_array = GlVertexArray(gl);
  model.vertex_buffer = GlBuffer(gl);
  gl.BindVertexArray(model.vertex_array.Name());
  gl.BindBuffer(GL_ARRAY_BUFFER, model.vertex_buffer.Name());
  gl.BufferData(GL_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(model.mesh.vertices.size() * sizeof(RenderVertex)),
                model.mesh.vertices.data(),
                GL_STATIC_DRAW);
  DescribeFloats(gl, kAtPosition, 3, offsetof(RenderVertex, position));
  DescribeFloats(gl, kAtNormal, 3, offsetof(RenderVertex, normal));
  DescribeFloats(gl, kAtOnPage, 2, offsetof(RenderVertex, on_page));
  gl.EnableVertexAttribArray(kAtFace);
  gl.VertexAttribIPointer(kAtFace,
                          1,
                          GL_UNSIGNED_INT,
                          sizeof(RenderVertex),
                          reinterpret_cast<const void*>(offsetof(RenderVertex, face)));
}

}  // namespace

UploadedModel UploadModel(const GlFunctions& gl,
                          const TexturedModel& model,
                          int max_page_px,
                          std::vector<std::string>& warnings) {
  UploadedModel uploaded;
  uploaded.mesh = MakeRenderMesh(model);
  UploadVertices(gl, uploaded);
  for (int page = 0; page < static_cast<int>(model.pages.size()); ++page) {
    uploaded.pages.push_back(
        UploadTexturePage(gl, model.pages[page].srgb8, page + 1, max_page_px, warnings));
    if (uploaded.mesh.IsRepeated(page)) {
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    }
  }
  return uploaded;
}

}  // namespace groundglass
