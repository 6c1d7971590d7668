// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "viewer/gl_functions.h"

#include <vector>

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

// What is drawn next goes into the whole of this target.
void BindTarget(const GlFunctions& gl, const RenderTarget& target);

// Averages the samples of each pixel's colour into a target of the same size with one.
void AverageSamples(const GlFunctions& gl, const RenderTarget& from, const RenderTarget& to);

// What was drawn into a target of one sample: RGBA, its colours no longer weighted by the covered
// share, or RGB.
Image8 ReadPicture(const GlFunctions& gl, const RenderTarget& target, bool with_alpha);
// The numbers that were drawn into a target of labels, row by row.
std::vector<GLuint> ReadLabels(const GlFunctions& gl, const RenderTarget& target);

}  // namespace groundglass
