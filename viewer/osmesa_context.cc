// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/osmesa_context.h"

#include "scene/error.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdint>

namespace groundglass {
namespace {

class OsMesaContext : public GlContext {
 public:
  OsMesaContext() {
    const std::array<int, 11> attributes = {OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            3,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            3,
                                            OSMESA_DEPTH_BITS,
                                            0,
                                            0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (!context_) {
      throw Error("OSMesa gives no OpenGL 3.3 core context; install Mesa's libosmesa6");
    }
  }
  ~OsMesaContext() override { OSMesaDestroyContext(context_); }

  void MakeCurrent() override {
    if (!OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, kWindowPx, kWindowPx)) {
      throw Error("OSMesa cannot make its OpenGL context current");
    }
  }
  // Another thread may take it over as it is.
  void Release() override {}
  Function FindFunction(const char* name) override { return OSMesaGetProcAddress(name); }

 private:
  // OSMesa wants a picture to call its window; nothing is ever drawn there.
  static constexpr int kWindowPx = 4;
  std::array<uint8_t, 4 * kWindowPx* kWindowPx> window_ = {};
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> MakeOsMesaContext() { return std::make_unique<OsMesaContext>(); }

}  // namespace groundglass
