// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "viewer/gl_context.h"

namespace groundglass {

// EGL without a surface or a display server: Mesa's own platform for that, else the first device
// that EGL lists (graphics cards of other makers). Throws Error if neither gives a 3.3 core
// context.
std::unique_ptr<GlContext> MakeEglContext();

}  // namespace groundglass
