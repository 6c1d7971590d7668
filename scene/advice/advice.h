// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/advice/advice_line.h"
#include "scene/formats/scene.h"

#include <vector>

namespace groundglass {

// What is odd about a scene (docs/check.md): its model's size, axes and coordinates, where its
// cameras stand, its pictures. Silent about what is merely unusual: each is told only if the scene
// as it was read is implausible, and another reading of it (if one is named) plausible.
// `options`: as the model was read. Pictures are decoded if `with_pictures`.
std::vector<Advice> FindOddities(const Scene& scene,
                                 const ModelOptions& options = {},
                                 bool with_pictures = true);

// What of that is of the model by itself: its size, its coordinates, single faces that are turned.
// For cameras from elsewhere, which have no tags to be odd.
std::vector<Advice> FindModelOddities(const Scene& scene, const ModelOptions& options = {});

}  // namespace groundglass
