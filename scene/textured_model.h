// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

constexpr uint16_t kProvenanceNone = 0;
// Its texels' grey, sRGB: black would be taken for what is there.
constexpr uint8_t kNoPhotographSrgb8 = 172;
constexpr uint16_t kProvenanceFilled = 65535;

// One texture page. Row 0 is the top of the picture.
struct TexturePage {
  Image8 srgb8;         // 3 channels
  Image16 provenance;   // 1 channel: the photograph each texel came from, from 1 in name order; may
                        // be empty
  Image16 srgb16 = {};  // as srgb8 with 16 bits; may be empty
};

// Where one face lies on a page: texel coordinates (top-left origin, first texel's centre at
// (0.5, 0.5)) of each of the face's corners, in the face's order. Planar faces with a metric
// chart: the map is affine.
struct FaceTexture {
  int page = -1;  // -1: the face has no texture
  std::vector<Eigen::Vector2d> corners_texel;
};

struct TexturedModel {
  PolygonModel model;
  std::vector<FaceTexture> faces;  // one for each of the model's
  std::vector<TexturePage> pages;
};

}  // namespace groundglass
