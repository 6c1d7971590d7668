// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/render_target.h"

#include "scene/error.h"
#include "scene/srgb.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
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

// Alpha is a pixel's covered share; its colour was averaged with black where not covered, in
// linear light.
void UndoPremultiplication(Image8& rgba) {
  for (size_t i = 0; i < rgba.values.size(); i += 4) {
    const uint8_t alpha = rgba.values[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (int channel = 0; channel < 3; ++channel) {
      const float linear = LinearFromSrgb(rgba.values[i + channel] / 255.0f) * 255.0f / alpha;
      rgba.values[i + channel] = Srgb8FromLinear(linear);
    }
  }
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

void BindTarget(const GlFunctions& gl, const RenderTarget& target) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.Name());
  gl.Viewport(0, 0, target.width, target.height);
}

void AverageSamples(const GlFunctions& gl, const RenderTarget& from, const RenderTarget& to) {
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer.Name());
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer.Name());
  gl.BlitFramebuffer(
      0, 0, from.width, from.height, 0, 0, to.width, to.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

std::vector<GLuint> ReadLabels(const GlFunctions& gl, const RenderTarget& target) {
  std::vector<GLuint> labels(static_cast<size_t>(target.width) * target.height);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.Name());
  gl.ReadPixels(0, 0, target.width, target.height, GL_RED_INTEGER, GL_UNSIGNED_INT, labels.data());
  return labels;
}

Image8 ReadPicture(const GlFunctions& gl, const RenderTarget& target, bool with_alpha) {
  Image8 rgba(target.width, target.height, 4);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.Name());
  gl.ReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.values.data());
  if (with_alpha) {
    UndoPremultiplication(rgba);
    return rgba;
  }
  Image8 rgb(target.width, target.height, 3);
  const cv::Mat from(target.height, target.width, CV_8UC4, rgba.values.data());
  cv::Mat to(target.height, target.width, CV_8UC3, rgb.values.data());
  cv::cvtColor(from, to, cv::COLOR_RGBA2RGB);
  return rgb;
}

}  // namespace groundglass
