// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

// TinyGLTF under a name of our own. Assimp brings in Draco, whose library exports a TinyGLTF of
// another version; calls into the shared one then end up there, with another memory layout. So
// its header is compiled here (own_tiny_gltf.cc), and nothing else of it is linked.
// Pictures are ours to read and write, so it needs no stb.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf groundglass_tinygltf
#include <tiny_gltf.h>
