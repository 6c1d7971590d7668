// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "evaluate/truth.h"
#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace groundglass {

// A photograph as the oracle uses it: with its true camera, and where known the mask that says
// which pixels show the slide's mount.
struct OraclePhotograph {
  std::filesystem::path image_file;
  Camera camera;
  std::optional<std::filesystem::path> occlusion_mask_file;  // codes of truth/masks_occ
};

// The photographs of a truth's cameras, in `images` beside the truth folder. Throws Error naming
// the one that is missing.
std::vector<OraclePhotograph> FindOraclePhotographs(const Truth& truth);

struct OraclePicture {
  Image8 srgb8;    // 3 channels; black where no photograph shows the model
  Image8 covered;  // 1 channel: 255 where some photograph does
};

// What a texture from these photographs could show at best: each of 2 x 2 samples a pixel is traced
// to the model, and looked up (bicubic; Keys 1981, a = -1/2) in the one photograph that sees the
// very place and resolves its worse direction best; no texture lies between, and nothing is
// corrected: neither exposure nor what stands before the building. One picture for each camera.
// Photographs are decoded one after the other. Throws Error for a photograph that does not fit its
// camera.
std::vector<OraclePicture> RenderOracle(const PolygonModel& model,
                                        std::span<const OraclePhotograph> photographs,
                                        std::span<const Camera> cameras);

}  // namespace groundglass
