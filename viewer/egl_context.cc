// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/egl_context.h"

#include "scene/error.h"

// No windows of X or any other system.
#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <mutex>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

EGLDisplay FindDisplay(EGLenum platform, void* native) {
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return get_display ? get_display(platform, native, nullptr) : EGL_NO_DISPLAY;
}

std::vector<EGLDeviceEXT> ListDevices() {
  const auto query =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLint number = 0;
  if (!query || !query(0, nullptr, &number) || number < 1) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<size_t>(number));
  if (!query(number, devices.data(), &number)) return {};
  return devices;
}

// An OpenGL 3.3 core context that needs no configuration of a surface, or null.
EGLContext MakeCoreContext(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) ||
      !eglBindAPI(EGL_OPENGL_API)) {
    return EGL_NO_CONTEXT;
  }
  const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

class EglContext : public GlContext {
 public:
  EglContext() {
    // Displays are shared by all contexts of the process and are never closed: closing one would
    // take the others' contexts along.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    if (TryDisplay(FindDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY))) return;
    for (EGLDeviceEXT device : ListDevices()) {
      if (TryDisplay(FindDisplay(EGL_PLATFORM_DEVICE_EXT, device))) return;
    }
    throw Error(
        "EGL gives no OpenGL 3.3 core context without a surface; install Mesa's libegl-mesa0 and "
        "libgl1-mesa-dri, or the graphics card's driver");
  }
  ~EglContext() override {
    if (eglGetCurrentContext() == context_) EglContext::Release();
    eglDestroyContext(display_, context_);
  }

  void MakeCurrent() override {
    // Which interface is meant is remembered by thread.
    if (eglBindAPI(EGL_OPENGL_API) &&
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      return;
    }
    throw Error("viewer: EGL cannot make its OpenGL context current");
  }
  void Release() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  Function FindFunction(const char* name) override { return eglGetProcAddress(name); }

 private:
  bool TryDisplay(EGLDisplay display) {
    display_ = display;
    context_ = MakeCoreContext(display);
    return context_ != EGL_NO_CONTEXT;
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> MakeEglContext() { return std::make_unique<EglContext>(); }

}  // namespace groundglass
