// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/gl_context.h"

#include "scene/error.h"
#include "scene/text.h"

#ifdef GROUNDGLASS_HAS_EGL
#include "viewer/egl_context.h"
#endif
#ifdef GROUNDGLASS_HAS_OSMESA
#include "viewer/osmesa_context.h"
#endif

#include <cstdlib>

namespace groundglass {

const std::vector<GlBackend>& GlBackends() {
  static const std::vector<GlBackend> backends = {
#ifdef GROUNDGLASS_HAS_OSMESA
      {"osmesa", MakeOsMesaContext},
#endif
#ifdef GROUNDGLASS_HAS_EGL
      {"egl", MakeEglContext},
#endif
  };
  return backends;
}

std::unique_ptr<GlContext> MakeGlContext() {
  constexpr const char* kVariable = "GROUNDGLASS_GL";
  const char* wanted = std::getenv(kVariable);
  std::string names;
  std::string faults;
  for (const GlBackend& backend : GlBackends()) {
    names += (names.empty() ? "" : ", ") + backend.name;
    if (wanted != nullptr && *wanted != 0 && backend.name != wanted) continue;
    try {
      return backend.make();
    } catch (const Error& error) {
      faults += (faults.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  if (!faults.empty()) throw Error("viewer: " + faults);
  throw Error(std::string("the environment variable ") + kVariable + " is " + Quote(wanted) +
              "; expected one of what this program was built with: " + names);
}

}  // namespace groundglass
