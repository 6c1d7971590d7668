// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

// TinyGLTF under a name of our own: its header is compiled here (own_tiny_gltf.cc), and nothing
// else of it is linked. Other libraries (Draco's is one) export a TinyGLTF of another version, with
// another memory layout, and a program that links them too would call theirs.
// Pictures are ours to read and write, so it needs no stb.
//
// tiny_gltf.h gives hidden visibility to all that is declared within it, what it includes too: the
// system's functions are declared before, or a unity build links none of them.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf groundglass_tinygltf
#include <tiny_gltf.h>
