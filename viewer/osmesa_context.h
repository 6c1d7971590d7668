// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "viewer/gl_context.h"

namespace groundglass {

// Needs no display and no graphics card. Throws Error if the installed OSMesa gives no 3.3 core
// context. (Mesa has it no longer from 25.1 on.)
std::unique_ptr<GlContext> MakeOsMesaContext();

}  // namespace groundglass
