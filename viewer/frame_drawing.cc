// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/frame_drawing.h"

#include "viewer/shaders.h"

namespace groundglass {
namespace {

// Horizontal directions of the sky at the corners of clip space, for kFrameVertexShader.
Eigen::Matrix3d WorldFromClip(const Camera& pinhole) {
  Eigen::Matrix3d cam_from_clip = Eigen::Matrix3d::Zero();
  cam_from_clip(0, 0) = pinhole.width_px / (2 * pinhole.focal_x_px);
  cam_from_clip(0, 2) = (pinhole.width_px / 2.0 - pinhole.center_x_px) / pinhole.focal_x_px;
  cam_from_clip(1, 1) = pinhole.height_px / (2 * pinhole.focal_y_px);
  cam_from_clip(1, 2) = (pinhole.height_px / 2.0 - pinhole.center_y_px) / pinhole.focal_y_px;
  cam_from_clip(2, 2) = 1;
  return pinhole.cam_from_world.rotation.transpose() * cam_from_clip;
}

}  // namespace

FrameDrawing::FrameDrawing(const GlFunctions& gl)
    : gl_(gl),
      sky_program_(gl, kFrameVertexShader, kSkyFragmentShader),
      resolve_program_(gl, kFrameVertexShader, kResolveFragmentShader),
      frame_array_(gl),
      grid_(gl) {}

void FrameDrawing::DrawSky(const Camera& pinhole) const {
  sky_program_.Use();
  const Eigen::Matrix3f world_from_clip = WorldFromClip(pinhole).cast<float>();
  gl_.UniformMatrix3fv(
      sky_program_.Uniform("world_from_clip"), 1, GL_FALSE, world_from_clip.data());
  gl_.BindVertexArray(frame_array_.Name());
  // Behind what is there, by the share of each pixel that no face covers: in this way the sky
  // needs one sample for each pixel only.
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.Disable(GL_BLEND);
}

void FrameDrawing::UploadGrid(const PinholeFrame& frame) const {
  gl_.TexImage2D(GL_TEXTURE_2D,
                 0,
                 GL_RG32F,
                 frame.grid_width,
                 frame.grid_height,
                 0,
                 GL_RG,
                 GL_FLOAT,
                 frame.grid_px.data());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void FrameDrawing::DrawResolved(const RenderTarget& drawn,
                                const PinholeFrame& frame,
                                int samples) const {
  resolve_program_.Use();
  gl_.Uniform1i(resolve_program_.Uniform("drawn"), 0);
  gl_.Uniform1i(resolve_program_.Uniform("grid"), 1);
  gl_.Uniform1i(resolve_program_.Uniform("samples"), samples);
  gl_.Uniform1i(resolve_program_.Uniform("bent"), frame.is_bent ? 1 : 0);
  gl_.Uniform1f(resolve_program_.Uniform("grid_step"), PinholeFrame::kGridStep);
  gl_.Uniform2f(resolve_program_.Uniform("grid_size"),
                static_cast<float>(frame.grid_width),
                static_cast<float>(frame.grid_height));
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.BindTexture(GL_TEXTURE_2D, grid_.Name());
  if (frame.is_bent) UploadGrid(frame);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, drawn.texture.Name());
  gl_.BindVertexArray(frame_array_.Name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace groundglass
