// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace groundglass {

// An OpenGL 3.3 core context that draws off screen, into framebuffer objects only. Released when
// destroyed. A context may be used from one thread at a time, as long as it is current there
// (CurrentGlContext).
class GlContext {
 public:
  using Function = void (*)();

  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  virtual void MakeCurrent() = 0;
  virtual void Release() = 0;  // so that another thread may make it current
  // An OpenGL function by its name, or null.
  virtual Function FindFunction(const char* name) = 0;
};

// Holds a context current in this thread as long as it lives.
class CurrentGlContext {
 public:
  explicit CurrentGlContext(GlContext& context) : context_(context) { context_.MakeCurrent(); }
  CurrentGlContext(const CurrentGlContext&) = delete;
  CurrentGlContext& operator=(const CurrentGlContext&) = delete;
  ~CurrentGlContext() { context_.Release(); }

 private:
  GlContext& context_;
};

// Where OpenGL comes from.
struct GlBackend {
  std::string name;  // "osmesa"
  std::unique_ptr<GlContext> (*make)() = nullptr;
};

// Those that the program was built with, the first one first to be tried: OSMesa, Mesa's software
// rasteriser in memory, which gives the same bytes on every machine; EGL without a surface, which
// reaches a graphics card where there is one, and Mesa's rasteriser where there is none.
const std::vector<GlBackend>& GlBackends();

// The first backend that gives a context; the environment variable GROUNDGLASS_GL names one, and
// then it is that one or none. Throws Error with what was tried and what to install.
std::unique_ptr<GlContext> MakeGlContext();

}  // namespace groundglass
