// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "viewer/gl_functions.h"

namespace groundglass {

enum class TargetKind { kColour, kColourAndDepth, kLabelsAndDepth };

// A framebuffer of one colour and, if asked for, one depth picture.
struct RenderTarget {
  int width = 0;
  int height = 0;
  int multisamples = 1;
  GlFramebuffer framebuffer;
  GlTexture texture;      // the colour, with one sample for each pixel
  GlRenderbuffer colour;  // the colour, with several
  GlRenderbuffer depth;
};

// Makes `target` anew when what is asked of it has changed. multisamples: 1, or more for colour
// with depth. Error if OpenGL cannot draw at this size.
void FitTarget(const GlFunctions& gl,
               RenderTarget& target,
               int width,
               int height,
               int multisamples,
               TargetKind kind);

// What was drawn into a target of one sample: RGBA, its colours no longer weighted by the covered
// share, or RGB.
Image8 ReadPicture(const GlFunctions& gl, const RenderTarget& target, bool with_alpha);

}  // namespace groundglass
