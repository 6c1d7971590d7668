// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "viewer/gl_functions.h"
#include "viewer/pinhole_frame.h"
#include "viewer/render_target.h"

namespace groundglass {

// The programs that fill a whole frame, drawn into the target that is bound.
class FrameDrawing {
 public:
  // gl must outlive the object.
  explicit FrameDrawing(const GlFunctions& gl);

  // The sky behind what is there already.
  void DrawSky(const Camera& pinhole) const;
  // What was drawn of the pinhole frame, `samples` pixels each way averaged into one, and bent as
  // the lens bends it.
  void DrawResolved(const RenderTarget& drawn, const PinholeFrame& frame, int samples) const;

 private:
  void UploadGrid(const PinholeFrame& frame) const;

  const GlFunctions& gl_;
  GlProgram sky_program_;
  GlProgram resolve_program_;
  GlVertexArray frame_array_;  // without vertices: the shader knows the frame's corners
  GlTexture grid_;
};

}  // namespace groundglass
