// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <kainjow/mustache.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace groundglass {

// As RFC 4648 has it.
std::string EncodeBase64(std::span<const uint8_t> bytes);

// A picture for an <img> that holds it, made no wider than width_px and no larger than max_bytes,
// at lower quality first and smaller then: width, height and jpeg (in Base64).
kainjow::mustache::data PictureData(const Image8& srgb8, int width_px, size_t max_bytes);

// The picture made no wider than width_px.
Image8 ShrunkPicture(const Image8& srgb8, int width_px);

}  // namespace groundglass
