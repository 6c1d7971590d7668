// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <memory>

namespace groundglass {

// An OpenGL 3.3 core context that draws off screen, into framebuffer objects only. Released when
// destroyed. A context may be used from one thread at a time, after MakeCurrent() there.
class GlContext {
 public:
  using Function = void (*)();

  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  virtual void MakeCurrent() = 0;
  // An OpenGL function by its name, or null.
  virtual Function FindFunction(const char* name) = 0;
};

// Mesa's software rasteriser in memory: needs no display and no graphics card. Throws Error if the
// installed OSMesa gives no 3.3 core context.
std::unique_ptr<GlContext> MakeOsMesaContext();

}  // namespace groundglass
