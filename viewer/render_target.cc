// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/render_target.h"

#include "scene/error.h"

#include <string>

namespace groundglass {
namespace {

RenderTarget MakeTarget(
    const GlFunctions& gl, int width, int height, int multisamples, TargetKind kind) {
  RenderTarget target;
  target.width = width;
  target.height = height;
  target.multisamples = multisamples;
  target.framebuffer = GlFramebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.Name());
  if (multisamples > 1) {
    target.colour = GlRenderbuffer(gl);
    gl.BindRenderbuffer(GL_RENDERBUFFER, target.colour.Name());
    gl.RenderbufferStorageMultisample(
        GL_RENDERBUFFER, multisamples, GL_SRGB8_ALPHA8, width, height);
    gl.FramebufferRenderbuffer(
        GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target.colour.Name());
  } else {
    target.texture = GlTexture(gl);
    gl.BindTexture(GL_TEXTURE_2D, target.texture.Name());
    if (kind == TargetKind::kLabelsAndDepth) {
      gl.TexImage2D(
          GL_TEXTURE_2D, 0, GL_R32UI, width, height, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    } else {
      gl.TexImage2D(
          GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    }
    const GLint filter = kind == TargetKind::kLabelsAndDepth ? GL_NEAREST : GL_LINEAR;
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.FramebufferTexture2D(
        GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture.Name(), 0);
  }
  if (kind != TargetKind::kColour) {
    target.depth = GlRenderbuffer(gl);
    gl.BindRenderbuffer(GL_RENDERBUFFER, target.depth.Name());
    gl.RenderbufferStorageMultisample(
        GL_RENDERBUFFER, multisamples > 1 ? multisamples : 0, GL_DEPTH_COMPONENT24, width, height);
    gl.FramebufferRenderbuffer(
        GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.depth.Name());
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error("viewer: this OpenGL cannot draw into a picture of " + std::to_string(width) +
                " x " + std::to_string(height) + " with " + std::to_string(multisamples) +
                " samples a pixel");
  }
  return target;
}

}  // namespace

void FitTarget(const GlFunctions& gl,
               RenderTarget& target,
               int width,
               int height,
               int multisamples,
               TargetKind kind) {
  if (target.width == width && target.height == height && target.multisamples == multisamples) {
    return;
  }
  target = MakeTarget(gl, width, height, multisamples, kind);
}

}  // namespace groundglass
