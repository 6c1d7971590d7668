// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#define TINYGLTF_IMPLEMENTATION
#include "scene/formats/own_tiny_gltf.h"
